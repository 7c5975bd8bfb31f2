// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/two_view/rotation_from_bearings.hpp"

namespace sslam::embedded {

void run_rotation_from_bearings(std::span<const BearingMatch<float>> matches,
                                const RotationFromBearingsOptions<float>& options, std::uint64_t seed,
                                std::span<std::uint8_t> inliers, RotationFromBearings<float>& out) noexcept {
  out = rotation_from_bearings(matches, options, seed, inliers);
}

}  // namespace sslam::embedded
