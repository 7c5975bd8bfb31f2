// SPDX-License-Identifier: BSD-3-Clause
// Distances of a line from the plane that it is tied to, at both ends of the part that has been seen, with
// analytic Jacobians: where both vanish, the line's direction lies in the plane too.
#pragma once

#include "sslam/geometry/line3.hpp"
#include "sslam/geometry/plane3.hpp"

namespace sslam {

// e_i = n . X_i - d with X_i = u x m + u u^T P_i, the point of the line (moment m, direction u) that is
// closest to the end P_i; units of the map.
template <Scalar S>
struct LineOnPlane {
  Vec2<S> error;           // at start and end
  Mat<S, 2, 4> wrt_line;   // world; Line3::retract
  Mat<S, 2, 3> wrt_plane;  // Plane3::retract
};

// The ends say where along the line it is asked for; they do not move with it.
template <Scalar S>
[[nodiscard]] LineOnPlane<S> line_on_plane(const Plane3<S>& plane, const Line3<S>& line, const Vec3<S>& start,
                                           const Vec3<S>& end) noexcept {
  LineOnPlane<S> out;
  const Vec3<S>&n = plane.normal, &u = line.direction;
  const Mat<S, 3, 2> basis = tangent_basis(n);
  Mat<S, 2, 6> wrt_pluecker;  // by moment and direction
  for (int i = 0; i < 2; ++i) {
    const Vec3<S>& p = i == 0 ? start : end;
    const Vec3<S> x = line.point_closest_to(p);
    out.error[i] = plane.offset(x);
    out.wrt_plane.row(i) << (x.transpose() * basis), S(-1);
    // n . (u x dm) = (n x u) . dm;  n . (du x m) = (m x n) . du;  n . d(u u^T P) = (u.P) n.du + (n.u) P.du.
    wrt_pluecker.row(i) << n.cross(u).transpose(),
        (line.moment.cross(n) + u.dot(p) * n + n.dot(u) * p).transpose();
  }
  out.wrt_line = wrt_pluecker * line.retract_jacobian();
  return out;
}

}  // namespace sslam
