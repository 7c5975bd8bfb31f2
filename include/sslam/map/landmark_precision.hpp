// SPDX-License-Identifier: BSD-3-Clause
// How sure the place of a landmark is along a direction, by the views that observe it.
#pragma once

#include <cmath>
#include <limits>

#include "sslam/map/map.hpp"
#include "sslam/solver/least_squares/positive_inverse.hpp"

namespace sslam {

namespace detail {

template <Scalar S>
[[nodiscard]] S sigma_along(const Mat3<S>& information, const Vec3<S>& direction) noexcept {
  Mat3<S> root;
  if (!inverse_root<S, 3>(information, root)) return std::numeric_limits<S>::infinity();
  return (root * direction).norm();
}

}  // namespace detail

// Standard deviation of the point along the unit vector, units of the map; infinite where its rays are
// parallel. To first order each view gives f^2 / (z sigma)^2 across its ray and nothing along it; poses count
// as known.
template <Scalar S>
[[nodiscard]] S sigma_along(const Map<S>& map, const PointLandmark<S>& point, const Vec3<S>& direction) {
  Mat3<S> information = Mat3<S>::Zero();
  for (const Observation& o : point.observations) {
    const Keyframe<S>& kf = map.keyframes[map.index(o.keyframe)];
    const Vec3<S> from_camera = point.position - kf.cam_from_world.inverse().translation;
    const S at_one = kf.frame.pinhole.fx / (kf.frame.points[map.index(o.feature)].sigma * from_camera.norm());
    const Vec3<S> ray = from_camera.normalized();
    information += at_one * at_one * (Mat3<S>::Identity() - ray * ray.transpose());
  }
  return detail::sigma_along(information, direction);
}

// The same for a line at the middle of what has been seen of it, in a direction across it: each view gives
// something across its plane through the line, and nothing within.
template <Scalar S>
[[nodiscard]] S sigma_along(const Map<S>& map, const LineLandmark<S>& line, const Vec3<S>& direction) {
  const Vec3<S> middle = (line.start + line.end) / 2;
  Mat3<S> information = Mat3<S>::Zero();
  for (const Observation& o : line.observations) {
    const Keyframe<S>& kf = map.keyframes[map.index(o.keyframe)];
    const Vec3<S> from_camera = middle - kf.cam_from_world.inverse().translation;
    const S at_one = kf.frame.pinhole.fx / (kf.frame.lines[map.index(o.feature)].sigma * from_camera.norm());
    const Vec3<S> across = from_camera.cross(line.line.direction).normalized();
    information += at_one * at_one * (across * across.transpose());
  }
  information += information.trace() * (line.line.direction * line.line.direction.transpose());
  return detail::sigma_along(information, direction);
}

}  // namespace sslam
