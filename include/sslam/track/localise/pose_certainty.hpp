// SPDX-License-Identifier: BSD-3-Clause
// Which poses are certain enough to build on. One that little holds is still the best guess of where the
// camera is, but a map, and whatever else is learned from it, would take over its error.
#pragma once

#include "sslam/core/parameter.hpp"
#include "sslam/geometry/spread.hpp"
#include "sslam/track/contract/pose_estimate.hpp"

namespace sslam {

// Standard deviations up to which a pose is certain; 0: whatever it is. A camera of focal length f pixels
// that is turned by r radians, and stands s scene depths aside, shows the scene f * r and f * s pixels off.
template <Scalar S>
struct PoseCertaintyOptions {
  S max_rotation_sigma = radians(S(1.5));  // about the worst axis
  S max_position_sigma = S(0.03);          // along the worst direction, over the median scene depth

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_rotation_sigma", self.max_rotation_sigma, Unit::kDegrees, 0, 180,
          "of the rotation about its worst axis, above which a pose is uncertain; 0: none is");
    visit("max_position_sigma", self.max_position_sigma, Unit::kNumber, 0, kUnbounded,
          "of the camera's place over the median scene depth, above which a pose is uncertain; 0: none is");
  }
};
static_assert(Described<PoseCertaintyOptions<double>>);

template <Scalar S>
class PoseCertainty {
 public:
  PoseCertaintyOptions<S> options;

  // A pose that claims no covariance is taken as it is: there is nothing to judge it by.
  [[nodiscard]] bool certain(const PoseEstimate<S>& estimate) const {
    const Mat6<S>& covariance = estimate.covariance;
    if ((covariance.array() == S(0)).all()) return true;
    if (!covariance.allFinite()) return false;
    return within(covariance.template topLeftCorner<3, 3>(), options.max_rotation_sigma) &&
           within(covariance.template bottomRightCorner<3, 3>(),
                  options.max_position_sigma * estimate.scene_depth);
  }

 private:
  [[nodiscard]] static bool within(const Mat3<S>& covariance, S limit) {
    return limit == 0 || largest_sigma<S>(covariance) <= limit;
  }
};

}  // namespace sslam
