// SPDX-License-Identifier: BSD-3-Clause
// The unit sphere S2: tangent bases, and the chart that flattens it around an axis.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "sslam/core/types.hpp"

namespace sslam {

// Two orthonormal columns that span the plane perpendicular to the unit vector a; right-handed: b0 x b1 = a.
template <Scalar S>
[[nodiscard]] Mat<S, 3, 2> tangent_basis(const Vec3<S>& a) noexcept {
  // Duff et al., JCGT 2017: branch-free except for the sign.
  const S sign = std::copysign(S(1), a.z());
  const S c = -1 / (sign + a.z());
  const S d = a.x() * a.y() * c;
  Mat<S, 3, 2> basis;
  basis.col(0) = Vec3<S>(1 + sign * a.x() * a.x() * c, sign * d, -sign * a.x());
  basis.col(1) = Vec3<S>(d, sign + a.y() * a.y() * c, -a.y());
  return basis;
}

// Logarithm and exponential of the sphere at `axis`: they keep distances from the axis, in radians.
template <Scalar S>
struct TangentChart {
  Vec3<S> axis;
  Mat<S, 3, 2> basis;

  explicit TangentChart(const Vec3<S>& unit_axis) noexcept
      : axis(unit_axis), basis(tangent_basis(unit_axis)) {}

  [[nodiscard]] Vec2<S> to_plane(const Vec3<S>& unit) const noexcept {
    const Vec2<S> m = basis.transpose() * unit;
    const S sine = m.norm();
    const S cosine = axis.dot(unit);
    if (!(sine > S(1e-12))) return m;
    return m * (std::atan2(sine, cosine) / sine);
  }
  [[nodiscard]] Vec3<S> to_sphere(const Vec2<S>& m) const noexcept {
    const S angle = m.norm();
    const S scale = angle > S(1e-6) ? std::sin(angle) / angle : 1 - angle * angle / 6;
    return (std::cos(angle) * axis + scale * (basis * m)).normalized();
  }
};

}  // namespace sslam
