// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/compiled_kernels.hpp"

namespace sslam {

template TranslationEstimate<double> translation_from_rotation(std::span<const BearingMatch<double>>,
                                                               const SO3<double>&,
                                                               const TranslationOptions<double>&,
                                                               std::uint64_t,
                                                               std::span<std::uint8_t>) noexcept;
template RelativePoseSummary<double> refine_relative_pose(std::span<const BearingMatch<double>>, SO3<double>&,
                                                          Vec3<double>&, const RelativePoseOptions<double>&,
                                                          std::span<std::uint8_t>) noexcept;
template RelativePoseSummary<double> find_relative_pose(std::span<const BearingMatch<double>>,
                                                        const FindRelativePoseOptions<double>&, std::uint64_t,
                                                        SO3<double>&, Vec3<double>&,
                                                        std::span<std::uint8_t>) noexcept;

}  // namespace sslam
