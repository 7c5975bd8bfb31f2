// SPDX-License-Identifier: BSD-3-Clause
// Constant velocity between frames, by their stamps: a dropped frame makes a longer step, not a wrong one.
#pragma once

#include "sslam/core/parameter.hpp"
#include "sslam/geometry/se3.hpp"

namespace sslam {

struct MotionOptions {
  double horizon = 0.3;  // seconds without a pose, through which the velocity is believed; 0: not at all

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("horizon", self.horizon, Unit::kSeconds, 0, 3600,
          "without a pose, through which the velocity is believed; 0: none");
  }
};
static_assert(Described<MotionOptions>);

template <Scalar S>
class ConstantVelocity {
 public:
  MotionOptions options;

  // cam_from_world expected at `stamp`, seconds.
  [[nodiscard]] SE3<S> predict(double stamp) const {
    if (!moving_) return pose_;
    return SE3<S>::exp(velocity_ * static_cast<S>(stamp - stamp_)) * pose_;
  }

  [[nodiscard]] bool reaches(double stamp) const noexcept {
    return moving_ && stamp - stamp_ <= options.horizon;
  }

  void update(const SE3<S>& cam_from_world, double stamp) {
    const double dt = stamp - stamp_;
    if (seen_ && dt > 0) {
      velocity_ = (cam_from_world * pose_.inverse()).log() / static_cast<S>(dt);
      moving_ = velocity_.allFinite();
    }
    pose_ = cam_from_world;
    stamp_ = stamp;
    seen_ = true;
  }

  // The pose is another because the world has moved; lengths are `scale` times what they were.
  void move_to(const SE3<S>& cam_from_world, S scale) {
    pose_ = cam_from_world;
    velocity_.template tail<3>() *= scale;
  }

  // Forgets the velocity and keeps the pose: after a loss, or where a pose came from elsewhere.
  void stop() noexcept { moving_ = seen_ = false; }

 private:
  SE3<S> pose_;
  Vec6<S> velocity_ = Vec6<S>::Zero();  // left tangent of the pose per second
  double stamp_ = 0;
  bool seen_ = false;
  bool moving_ = false;
};

}  // namespace sslam
