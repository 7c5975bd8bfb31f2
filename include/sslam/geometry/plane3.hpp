// SPDX-License-Identifier: BSD-3-Clause
// Planes in space by unit normal and distance from the origin, with an update of three degrees of freedom.
#pragma once

#include "sslam/geometry/manifold.hpp"
#include "sslam/geometry/se3.hpp"
#include "sslam/geometry/sim3.hpp"
#include "sslam/geometry/sphere.hpp"

namespace sslam {

// The points X with  normal . X = distance.
template <Scalar S>
struct Plane3 {
  using ScalarType = S;
  using Tangent = Vec3<S>;
  static constexpr int kDof = 3;

  Vec3<S> normal = Vec3<S>::UnitZ();  // unit
  S distance = 0;                     // signed, along the normal

  // Signed distance of a point from the plane.
  [[nodiscard]] S offset(const Vec3<S>& x) const noexcept { return normal.dot(x) - distance; }

  // The distance to the plane along the ray, in lengths of `ray`. False for a ray within 3 degrees of the
  // plane, where a small error of either causes a large error of the intersection.
  [[nodiscard]] bool meet(const Vec3<S>& origin, const Vec3<S>& ray, S& along) const noexcept {
    const S rate = normal.dot(ray);
    if (!(std::abs(rate) > S(0.05) * ray.norm())) return false;
    along = -offset(origin) / rate;
    return true;
  }

  // delta[0..1] moves the normal in its tangent chart, delta[2] is added to the distance.
  [[nodiscard]] Plane3 retract(const Vec3<S>& delta) const noexcept {
    return {TangentChart<S>(normal).to_sphere(delta.template head<2>()), distance + delta[2]};
  }

  // Derivatives of (normal, distance), stacked, with respect to the tangent at zero.
  [[nodiscard]] Mat<S, 4, 3> retract_jacobian() const noexcept {
    Mat<S, 4, 3> j = Mat<S, 4, 3>::Zero();
    j.template topLeftCorner<3, 2>() = tangent_basis(normal);
    j(3, 2) = 1;
    return j;
  }

  template <Scalar T>
  [[nodiscard]] Plane3<T> cast() const noexcept {
    return {normal.template cast<T>().normalized(), static_cast<T>(distance)};
  }
};
static_assert(Manifold<Plane3<float>> && Manifold<Plane3<double>>);

// The same plane in frame a: n_a = R n_b, d_a = s d_b + n_a . t.
template <Scalar S>
[[nodiscard]] Plane3<S> transform(const Sim3<S>& a_from_b, const Plane3<S>& plane) noexcept {
  const Vec3<S> n = a_from_b.rotation * plane.normal;
  return {n, a_from_b.scale * plane.distance + n.dot(a_from_b.translation)};
}

template <Scalar S>
[[nodiscard]] Plane3<S> transform(const SE3<S>& a_from_b, const Plane3<S>& plane) noexcept {
  return transform(Sim3<S>{a_from_b.rotation, a_from_b.translation, S(1)}, plane);
}

}  // namespace sslam
