// SPDX-License-Identifier: BSD-3-Clause
// Segments and lines in the image, and the plane that a segment spans with the camera centre.
#pragma once

#include <cmath>

#include "sslam/geometry/camera.hpp"

namespace sslam {

template <Scalar S>
struct Segment2 {
  Vec2<S> start, end;  // pixels

  [[nodiscard]] S length() const noexcept { return (end - start).norm(); }
  [[nodiscard]] Vec2<S> midpoint() const noexcept { return (start + end) / 2; }
  // Unit direction; zero for a segment without length.
  [[nodiscard]] Vec2<S> direction() const noexcept {
    const Vec2<S> d = end - start;
    const S norm = d.norm();
    return norm > 0 ? Vec2<S>(d / norm) : Vec2<S>(Vec2<S>::Zero());
  }
};

// The sine of the angle from a to b, positive from x towards y, times both lengths.
template <Scalar S>
[[nodiscard]] S cross(const Vec2<S>& a, const Vec2<S>& b) noexcept {
  return a.x() * b.y() - a.y() * b.x();
}

// Unit direction of the largest spread of points with the second moments xx, xy, yy; the sign follows
// `towards`.
template <Scalar S>
[[nodiscard]] Vec2<S> principal_axis(S xx, S xy, S yy, const Vec2<S>& towards) noexcept {
  const S angle = S(0.5) * std::atan2(2 * xy, xx - yy);
  const Vec2<S> axis(std::cos(angle), std::sin(angle));
  return axis.dot(towards) < 0 ? Vec2<S>(-axis) : axis;
}

// (a, b, c) with a^2 + b^2 = 1: l . (u, v, 1) is the signed distance from the line. Zero where p = q.
template <Scalar S>
[[nodiscard]] Vec3<S> line_through(const Vec2<S>& p, const Vec2<S>& q) noexcept {
  const Vec2<S> d = q - p;
  const S norm = d.norm();
  if (!(norm > 0)) return Vec3<S>::Zero();
  const Vec2<S> n(-d.y() / norm, d.x() / norm);
  return {n.x(), n.y(), -n.dot(p)};
}

// Unit normal, camera frame, of the plane through the camera centre and the segment. Zero for a
// segment without length.
template <Scalar S>
[[nodiscard]] Vec3<S> interpretation_plane(const Segment2<S>& segment, const Pinhole<S>& pinhole) noexcept {
  return pinhole.unproject(segment.start).cross(pinhole.unproject(segment.end)).normalized();
}

}  // namespace sslam
