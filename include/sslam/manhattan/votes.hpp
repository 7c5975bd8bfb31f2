// SPDX-License-Identifier: BSD-3-Clause
// The votes for a Manhattan frame: surface normals, which are points on the sphere, and line segments, whose
// directions are only known to lie on a great circle.
#pragma once

#include <algorithm>
#include <cmath>

#include "sslam/geometry/camera.hpp"
#include "sslam/geometry/line2.hpp"
#include "sslam/solver/modes/mean_shift.hpp"

namespace sslam {

// Unit surface normals in the camera frame.
template <Scalar V>
using NormalView = DirectionView<V>;

// A segment's direction d satisfies plane_normal . d = 0. The image measures the turn of that plane about the
// ray to the middle of the segment; sigma is the standard deviation of this turn, radians.
template <Scalar S>
struct LineVote {
  Vec3<S> plane_normal;  // unit normal of the plane through the camera centre and the segment, camera frame
  S sigma;               // radians
  Vec3<S> ray;           // unit ray to the middle of the segment; plane_normal . ray = 0
};

// The vote of a segment whose endpoints have a standard deviation of pixel_sigma across the segment. If the
// rays of its ends are an angle beta apart, the plane has sigma = pixel_sigma / (f sqrt(2) sin(beta / 2)).
template <Scalar S>
[[nodiscard]] LineVote<S> line_vote(const Segment2<S>& segment, const Pinhole<S>& pinhole,
                                    S pixel_sigma) noexcept {
  const Vec3<S> start = pinhole.unproject(segment.start).normalized();
  const Vec3<S> end = pinhole.unproject(segment.end).normalized();
  const S focal = std::sqrt(std::abs(pinhole.fx * pinhole.fy));
  const S half_sine = std::max((end - start).norm() / S(2), S(1e-6));
  return {start.cross(end).normalized(), pixel_sigma / (focal * std::numbers::sqrt2_v<S> * half_sine),
          (start + end).normalized()};
}

}  // namespace sslam
