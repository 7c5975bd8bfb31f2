// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/two_view/find_relative_pose.hpp"

namespace sslam::embedded {

void run_find_relative_pose(std::span<const BearingMatch<float>> matches,
                            const FindRelativePoseOptions<float>& options, std::uint64_t seed,
                            SO3<float>& R_10, Vec3<float>& t_10, std::span<std::uint8_t> inliers,
                            RelativePoseSummary<float>& out) noexcept {
  out = find_relative_pose(matches, options, seed, R_10, t_10, inliers);
}

}  // namespace sslam::embedded
