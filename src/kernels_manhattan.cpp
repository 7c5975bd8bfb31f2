// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/compiled_kernels.hpp"

namespace sslam {

template ManhattanEstimate<double> track_manhattan(const NormalView<float>&,
                                                   std::span<const LineVote<double>>,
                                                   const ManhattanPrior<double>&,
                                                   const ManhattanOptions<double>&,
                                                   std::span<std::int8_t>) noexcept;
template ManhattanEstimate<double> find_manhattan(const NormalView<float>&, std::span<const LineVote<double>>,
                                                  const SearchOptions<double>&, std::uint64_t,
                                                  std::span<std::int8_t>) noexcept;

}  // namespace sslam
