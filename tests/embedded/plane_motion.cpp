// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/two_view/plane_motion.hpp"

namespace sslam::embedded {

void run_plane_motion(std::span<const BearingMatch<float>> matches, const SO3<float>& R_10,
                      const Vec3<float>& n_0, const PlaneMotionOptions<float>& options, std::uint64_t seed,
                      std::span<std::uint8_t> inliers, PlaneMotion<float>& out) noexcept {
  out = plane_motion(matches, R_10, n_0, options, seed, inliers);
}

}  // namespace sslam::embedded
