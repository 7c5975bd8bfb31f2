// SPDX-License-Identifier: BSD-3-Clause
// What triangulation needs of a segment seen from a known pose: its plane, its errors against a line, and the
// stretch of the line that it shows.
#pragma once

#include <cmath>
#include <span>

#include "sslam/geometry/line2.hpp"
#include "sslam/geometry/line3.hpp"
#include "sslam/residual/line_reprojection.hpp"

namespace sslam {

template <Scalar S>
struct LineView {
  SE3<S> cam_from_world;
  Segment2<S> segment;   // normalised, undistorted coordinates, at depth 1
  S sigma = S(1) / 500;  // standard deviation of an end across the segment: pixels over focal length
};

// From a segment and its sigma in pixels.
template <Scalar S>
[[nodiscard]] LineView<S> make_line_view(const SE3<S>& cam_from_world, const Pinhole<S>& pinhole,
                                         const Segment2<S>& segment, S sigma) noexcept {
  return {cam_from_world,
          {pinhole.unproject(segment.start).template head<2>(),
           pinhole.unproject(segment.end).template head<2>()},
          sigma / pinhole.fx};
}

template <Scalar S>
[[nodiscard]] bool is_finite(const LineView<S>& view) noexcept {
  return view.cam_from_world.translation.allFinite() && view.cam_from_world.rotation.matrix().allFinite() &&
         view.segment.start.allFinite() && view.segment.end.allFinite() && std::isfinite(view.sigma) &&
         view.sigma > 0;
}

// World, unless said otherwise; centres are relative to an origin that the caller keeps near the cameras, so
// that a float does not lose its digits far from the origin of the map.
template <Scalar S>
struct LineGeometry {
  const LineView<S>& view;
  Mat3<S> R;       // camera from world
  Vec3<S> centre;  // of the camera
  Vec3<S> ray[2];  // unit, to the ends of the segment

  LineGeometry(const LineView<S>& v, const Vec3<S>& origin) noexcept
      : view(v), R(v.cam_from_world.rotation.matrix()) {
    centre = -(R.transpose() * v.cam_from_world.translation) - origin;
    ray[0] = R.transpose() * v.segment.start.homogeneous().normalized();
    ray[1] = R.transpose() * v.segment.end.homogeneous().normalized();
  }
  [[nodiscard]] SE3<S> camera_from_origin() const noexcept {
    return {view.cam_from_world.rotation, -(R * centre)};
  }
};

// The part of a line that one view shows, as distances along it from its point nearest to the origin.
template <Scalar S>
struct LineStretch {
  S low = 0, high = 0;
  bool forward = true;   // the line's direction is that of the segment, start to end
  bool in_front = true;  // both ends
  bool bounded = true;   // false when the line runs along the ray to an end
};

template <Scalar S>
[[nodiscard]] LineStretch<S> seen_stretch(const LineGeometry<S>& geometry, const Line3<S>& line,
                                          S min_depth) noexcept {
  constexpr S kLeastSine = S(0.01);
  LineStretch<S> stretch;
  S at[2];
  for (int i = 0; i < 2; ++i) {
    const Vec3<S>& ray = geometry.ray[i];
    if (line.direction.cross(ray).norm() < kLeastSine) stretch.bounded = false;
    const Vec3<S> x = line.closest_to_ray(geometry.centre, ray);
    if (!((geometry.R * (x - geometry.centre)).z() > min_depth)) stretch.in_front = false;
    at[i] = line.direction.dot(x);
  }
  stretch.low = std::min(at[0], at[1]);
  stretch.high = std::max(at[0], at[1]);
  stretch.forward = at[0] <= at[1];
  return stretch;
}

}  // namespace sslam
