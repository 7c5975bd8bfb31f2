// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/manhattan/search.hpp"

namespace sslam::embedded {

void run_find_manhattan(const NormalView<float>& normals, std::span<const LineVote<float>> lines,
                        const SearchOptions<float>& options, std::uint64_t seed,
                        std::span<std::int8_t> axis_of, ManhattanEstimate<float>& out) noexcept {
  out = find_manhattan(normals, lines, options, seed, axis_of);
}

}  // namespace sslam::embedded
