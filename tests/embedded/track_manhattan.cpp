// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/manhattan/rotation.hpp"

namespace sslam::embedded {

void run_track_manhattan(const NormalView<float>& normals, std::span<const LineVote<float>> lines,
                         const ManhattanPrior<float>& prior, const ManhattanOptions<float>& options,
                         std::span<std::int8_t> axis_of, ManhattanEstimate<float>& out) noexcept {
  out = track_manhattan(normals, lines, prior, options, axis_of);
}

}  // namespace sslam::embedded
