// SPDX-License-Identifier: BSD-3-Clause
// Which way is down, for cameras that are held upright on the whole.
#pragma once

#include <cmath>
#include <span>

#include "sslam/map/map.hpp"

namespace sslam {

// Mean of the keyframes' y axes, in the world: shorter the more these differ; zero where there is no
// keyframe.
template <Scalar S>
[[nodiscard]] Vec3<S> mean_down(const Map<S>& map) {
  Vec3<S> sum = Vec3<S>::Zero();
  int count = 0;
  for (const Keyframe<S>& kf : map.keyframes) {
    if (!kf.alive()) continue;
    sum += kf.cam_from_world.inverse().rotation * Vec3<S>(0, 1, 0);
    ++count;
  }
  return count > 0 ? Vec3<S>(sum / static_cast<S>(count)) : sum;
}

// The axis of these Manhattan frames that is nearest to `down`, a unit vector, and points the same way; zero
// where none is within `max_lean`, radians.
template <Scalar S>
[[nodiscard]] Vec3<S> vertical_axis(std::span<const SO3<S>> world_from_manhattan, const Vec3<S>& down,
                                    S max_lean) {
  Vec3<S> best = Vec3<S>::Zero();
  S most = std::cos(max_lean);
  for (const SO3<S>& frame : world_from_manhattan)
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3<S> direction = frame.matrix().col(axis);
      const S cosine = direction.dot(down);
      if (std::abs(cosine) <= most) continue;
      most = std::abs(cosine);
      best = cosine > 0 ? direction : Vec3<S>(-direction);
    }
  return best;
}

// Where up is: the axis of the first Manhattan frame that is nearest to the cameras' own up, else that
// itself; -y of the world, as the first camera had it, where they say nothing.
template <Scalar S>
[[nodiscard]] Vec3<S> up_direction(const Map<S>& map) {
  const Vec3<S> down = mean_down(map);
  if (!(down.norm() > S(1e-9))) return -Vec3<S>::UnitY();
  const std::span<const SO3<S>> frames = map.world_from_manhattan;
  const Vec3<S> axis =
      vertical_axis<S>(frames.first(frames.empty() ? 0 : 1), down.normalized(), radians(S(30)));
  return axis.isZero() ? Vec3<S>(-down.normalized()) : Vec3<S>(-axis);
}

}  // namespace sslam
