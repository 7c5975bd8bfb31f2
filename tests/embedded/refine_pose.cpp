// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/pose/pose_refinement.hpp"

namespace sslam::embedded {

void run_refine_pose(const Pinhole<float>& pinhole, std::span<const PointObservation<float>> points,
                     std::span<const LineObservation<float>> lines, SE3<float>& cam_from_world,
                     const PoseRefinementOptions<float>& options, std::span<std::uint8_t> point_inliers,
                     std::span<std::uint8_t> line_inliers, const RotationPrior<float>* prior,
                     PoseSummary<float, 6>& out) noexcept {
  out = refine_pose(pinhole, points, lines, cam_from_world, options, point_inliers, line_inliers, prior);
}

}  // namespace sslam::embedded
