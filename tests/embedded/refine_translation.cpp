// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/pose/pose_refinement.hpp"

namespace sslam::embedded {

void run_refine_translation(const Pinhole<float>& pinhole, std::span<const PointObservation<float>> points,
                            std::span<const LineObservation<float>> lines, SE3<float>& cam_from_world,
                            const PoseRefinementOptions<float>& options,
                            std::span<std::uint8_t> point_inliers, std::span<std::uint8_t> line_inliers,
                            PoseSummary<float, 3>& out) noexcept {
  out = refine_translation(pinhole, points, lines, cam_from_world, options, point_inliers, line_inliers);
}

}  // namespace sslam::embedded
