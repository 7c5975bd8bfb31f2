// SPDX-License-Identifier: BSD-3-Clause
// How the camera moves at each frame of a trajectory: the derivatives of a cubic spline through its poses.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "sslam/geometry/se3.hpp"

namespace sslam {

template <Scalar S>
struct TimedPose {
  double stamp = 0;                      // seconds
  std::optional<SE3<S>> cam_from_world;  // none: the frame has no pose
};

// Left tangents of cam_from_world, per second and per second squared.
template <Scalar S>
struct FrameMotion {
  Vec6<S> velocity = Vec6<S>::Zero();
  Vec6<S> acceleration = Vec6<S>::Zero();

  // The tangent of the motion from the frame's stamp until so many seconds after it.
  [[nodiscard]] Vec6<S> until(S seconds) const noexcept {
    return seconds * velocity + (seconds * seconds / 2) * acceleration;
  }
};

namespace detail {

// Velocities at the knots of a natural cubic spline: `speed` is the mean velocity of each interval, `step`
// its length in seconds. The spline's second derivative is continuous, which gives a tridiagonal system
//   h1 m0 + 2 (h0 + h1) m1 + h0 m2 = 3 (h1 v0 + h0 v1),   2 m0 + m1 = 3 v0 and alike at the end.
template <Scalar S>
[[nodiscard]] std::vector<Vec6<S>> knot_velocities(const std::vector<Vec6<S>>& speed,
                                                   const std::vector<S>& step) {
  const std::size_t last = speed.size();
  std::vector<Vec6<S>> velocity(last + 1);
  std::vector<S> diagonal(last + 1), above(last + 1);
  diagonal[0] = 2;
  above[0] = 1;
  velocity[0] = 3 * speed[0];
  for (std::size_t i = 1; i <= last; ++i) {
    const bool end = i == last;
    const S below = end ? S(1) : step[i];
    const S factor = below / diagonal[i - 1];
    above[i] = end ? S(0) : step[i - 1];
    diagonal[i] = (end ? S(2) : 2 * (step[i - 1] + step[i])) - factor * above[i - 1];
    velocity[i] =
        end ? Vec6<S>(3 * speed[i - 1]) : Vec6<S>(3 * (step[i] * speed[i - 1] + step[i - 1] * speed[i]));
    velocity[i] -= factor * velocity[i - 1];
  }
  velocity[last] /= diagonal[last];
  for (std::size_t i = last; i-- > 0;) velocity[i] = (velocity[i] - above[i] * velocity[i + 1]) / diagonal[i];
  return velocity;
}

}  // namespace detail

// One answer a pose, in their order. None where the frame has no pose, or no neighbour within `longest_gap`
// seconds: a spline says nothing across a gap.
template <Scalar S>
[[nodiscard]] std::vector<std::optional<FrameMotion<S>>> frame_motions(std::span<const TimedPose<S>> poses,
                                                                       double longest_gap = 0.25) {
  std::vector<std::optional<FrameMotion<S>>> motions(poses.size());
  std::vector<Vec6<S>> speed;
  std::vector<S> step;
  for (std::size_t begin = 0, end = 0; begin < poses.size(); begin = end) {
    speed.clear();
    step.clear();
    for (end = begin + 1; end < poses.size(); ++end) {
      const TimedPose<S>&a = poses[end - 1], &b = poses[end];
      const double seconds = b.stamp - a.stamp;
      if (!a.cam_from_world || !b.cam_from_world || !(seconds > 0 && seconds <= longest_gap)) break;
      step.push_back(static_cast<S>(seconds));
      speed.push_back((*b.cam_from_world * a.cam_from_world->inverse()).log() / step.back());
    }
    if (speed.empty()) continue;
    const std::vector<Vec6<S>> velocity = detail::knot_velocities(speed, step);
    for (std::size_t i = 0; i < velocity.size(); ++i) {
      FrameMotion<S>& motion = motions[begin + i].emplace();
      motion.velocity = velocity[i];
      if (i < speed.size())  // natural: none at the end
        motion.acceleration = (6 * speed[i] - 4 * velocity[i] - 2 * velocity[i + 1]) / step[i];
    }
  }
  return motions;
}

}  // namespace sslam
