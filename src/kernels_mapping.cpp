// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/compiled_kernels.hpp"

namespace sslam {

template PointTriangulation<double> triangulate_point(std::span<const PointView<double>>,
                                                      const PointTriangulationOptions<double>&) noexcept;
template LineTriangulation<double> triangulate_line(std::span<const LineView<double>>,
                                                    const LineTriangulationOptions<double>&) noexcept;
template PoseSummary<double, 6> refine_pose(const Pinhole<double>&, std::span<const PointObservation<double>>,
                                            std::span<const LineObservation<double>>, SE3<double>&,
                                            const PoseRefinementOptions<double>&, std::span<std::uint8_t>,
                                            std::span<std::uint8_t>, const RotationPrior<double>*) noexcept;
template PoseSummary<double, 3> refine_translation(const Pinhole<double>&,
                                                   std::span<const PointObservation<double>>,
                                                   std::span<const LineObservation<double>>, SE3<double>&,
                                                   const PoseRefinementOptions<double>&,
                                                   std::span<std::uint8_t>, std::span<std::uint8_t>) noexcept;

}  // namespace sslam
