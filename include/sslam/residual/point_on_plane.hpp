// SPDX-License-Identifier: BSD-3-Clause
// Distance of a point from the plane that it is tied to, with analytic Jacobians.
#pragma once

#include "sslam/geometry/plane3.hpp"

namespace sslam {

// e = n . X - d, units of the map.
template <Scalar S>
struct PointOnPlane {
  Vec<S, 1> error;
  Mat<S, 1, 3> wrt_point;  // world
  Mat<S, 1, 3> wrt_plane;  // Plane3::retract
};

template <Scalar S>
[[nodiscard]] PointOnPlane<S> point_on_plane(const Plane3<S>& plane, const Vec3<S>& point) noexcept {
  PointOnPlane<S> out;
  out.error[0] = plane.offset(point);
  out.wrt_point = plane.normal.transpose();
  out.wrt_plane << (point.transpose() * tangent_basis(plane.normal)), S(-1);
  return out;
}

}  // namespace sslam
