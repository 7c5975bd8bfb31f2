// SPDX-License-Identifier: BSD-3-Clause
// Infinite lines in space: Pluecker coordinates (moment, direction) with a minimal update of four degrees of
// freedom.
#pragma once

#include <cmath>

#include "sslam/geometry/camera.hpp"
#include "sslam/geometry/se3.hpp"
#include "sslam/geometry/sim3.hpp"
#include "sslam/geometry/sphere.hpp"

namespace sslam {

template <Scalar S>
struct Line3 {
  using ScalarType = S;
  using Tangent = Vec4<S>;
  static constexpr int kDof = 4;

  Vec3<S> moment = Vec3<S>::Zero();  // X x direction for any point X on the line; its length is the distance
  Vec3<S> direction = Vec3<S>::UnitX();  // unit

  // The line through two different points.
  [[nodiscard]] static Line3 from_points(const Vec3<S>& p, const Vec3<S>& q) noexcept {
    const Vec3<S> d = (q - p).normalized();
    return {p.cross(d), d};
  }
  // The intersection of two planes n . X + offset = 0, which must not be parallel.
  [[nodiscard]] static Line3 from_planes(const Vec3<S>& n0, S offset0, const Vec3<S>& n1,
                                         S offset1) noexcept {
    const Vec3<S> d = n0.cross(n1);
    const S scale = 1 / d.norm();
    return {(offset0 * n1 - offset1 * n0) * scale, d * scale};
  }

  [[nodiscard]] Vec3<S> closest_point_to_origin() const noexcept { return direction.cross(moment); }
  [[nodiscard]] Vec3<S> point_closest_to(const Vec3<S>& p) const noexcept {
    return closest_point_to_origin() + direction * direction.dot(p);
  }
  // The point of the line nearest to a ray from `origin` along the unit vector `ray`; for a parallel ray,
  // nearest to its origin.
  [[nodiscard]] Vec3<S> closest_to_ray(const Vec3<S>& origin, const Vec3<S>& ray) const noexcept {
    const Vec3<S> p = point_closest_to(origin);
    const S cosine = direction.dot(ray);
    const S sine2 = 1 - cosine * cosine;
    if (!(sine2 > S(1e-12))) return p;
    return p + direction * (cosine * ray.dot(p - origin) / sine2);
  }

  // An orthonormal frame: along the moment, along the line, and from the origin to the line or back. Its
  // third axis is the direction of u0 x u1.
  [[nodiscard]] Mat3<S> frame() const noexcept {
    Mat3<S> u;
    const S distance = moment.norm();
    u.col(1) = direction;
    u.col(0) = distance > S(1e-12) ? Vec3<S>(moment / distance) : Vec3<S>(tangent_basis(direction).col(0));
    u.col(2) = u.col(0).cross(direction);
    return u;
  }

  // Orthonormal representation (Bartoli and Sturm, CVIU 2005): delta[0..2] turns the frame from the left,
  // delta[3] is added to the angle alpha with cot(alpha) = distance from the origin.
  [[nodiscard]] Line3 retract(const Vec4<S>& delta) const noexcept {
    const Mat3<S> u = SO3<S>::exp(delta.template head<3>()).matrix() * frame();
    const S alpha = std::atan2(S(1), moment.norm()) + delta[3];
    return {u.col(0) * (std::cos(alpha) / std::sin(alpha)), u.col(1).normalized()};
  }

  // Derivatives of (moment, direction), stacked, with respect to the tangent at zero.
  [[nodiscard]] Mat<S, 6, 4> retract_jacobian() const noexcept {
    Mat<S, 6, 4> j = Mat<S, 6, 4>::Zero();
    j.template block<3, 3>(0, 0) = -hat(moment);
    j.template block<3, 3>(3, 0) = -hat(direction);
    j.template block<3, 1>(0, 3) = -(1 + moment.squaredNorm()) * frame().col(0);
    return j;
  }

  template <Scalar T>
  [[nodiscard]] Line3<T> cast() const noexcept {
    return {moment.template cast<T>(), direction.template cast<T>().normalized()};
  }
};
static_assert(Manifold<Line3<float>> && Manifold<Line3<double>>);

// The same line in frame a: d_a = R d_b, n_a = R n_b + t x (R d_b).
template <Scalar S>
[[nodiscard]] Line3<S> transform(const SE3<S>& a_from_b, const Line3<S>& line) noexcept {
  const Vec3<S> d = a_from_b.rotation * line.direction;
  return {a_from_b.rotation * line.moment + a_from_b.translation.cross(d), d};
}

template <Scalar S>
[[nodiscard]] Line3<S> transform(const Sim3<S>& a_from_b, const Line3<S>& line) noexcept {
  const Vec3<S> d = a_from_b.rotation * line.direction;
  return {a_from_b.scale * (a_from_b.rotation * line.moment) + a_from_b.translation.cross(d), d};
}

// Image of a line of the camera frame: (a, b, c) in pixels with a^2 + b^2 = 1. Zero when the line runs
// through the camera centre or lies in the plane z = 0.
template <Scalar S>
[[nodiscard]] Vec3<S> project_line(const Pinhole<S>& k, const Line3<S>& in_camera) noexcept {
  const Vec3<S>& n = in_camera.moment;
  const Vec3<S> l(k.fy * n.x(), k.fx * n.y(),
                  k.fx * k.fy * n.z() - k.fy * k.cx * n.x() - k.fx * k.cy * n.y());
  const S norm = l.template head<2>().norm();
  if (!(norm > 0)) return Vec3<S>::Zero();
  return l / norm;
}

}  // namespace sslam
