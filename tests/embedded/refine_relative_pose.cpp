// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/two_view/relative_pose.hpp"

namespace sslam::embedded {

void run_refine_relative_pose(std::span<const BearingMatch<float>> matches, SO3<float>& R_10,
                              Vec3<float>& t_10, const RelativePoseOptions<float>& options,
                              std::span<std::uint8_t> inliers, RelativePoseSummary<float>& out) noexcept {
  out = refine_relative_pose(matches, R_10, t_10, options, inliers);
}

}  // namespace sslam::embedded
