// SPDX-License-Identifier: BSD-3-Clause
// Rigid motions: rotation and translation, with tangent xi = (phi, rho), rotation first, perturbed on the left.
#pragma once

#include "sslam/geometry/so3.hpp"

namespace sslam {

// Integral of Exp(s phi) over s in [0, 1]: takes rho to the translation of Exp(phi, rho)
// (Barfoot, State Estimation for Robotics, 2017, eq. 7.37).
template <Scalar S>
[[nodiscard]] Mat3<S> left_jacobian(const Vec3<S>& phi) noexcept {
  const S angle2 = phi.squaredNorm();
  S a = S(0.5) - angle2 / 24;          // (1 - cos) / angle^2
  S b = S(1) / 6 - angle2 / 120;       // (angle - sin) / angle^3
  if (angle2 > S(1e-3)) {
    const S angle = std::sqrt(angle2);
    const S half = std::sin(angle / 2);
    a = 2 * half * half / angle2;
    b = (angle - std::sin(angle)) / (angle2 * angle);
  }
  const Mat3<S> k = hat(phi);
  return Mat3<S>::Identity() + a * k + b * k * k;
}

template <Scalar S>
[[nodiscard]] Mat3<S> left_jacobian_inverse(const Vec3<S>& phi) noexcept {
  const S angle2 = phi.squaredNorm();
  S c = S(1) / 12 + angle2 / 720;
  if (angle2 > S(1e-3)) {
    const S angle = std::sqrt(angle2);
    c = (1 - (angle / 2) / std::tan(angle / 2)) / angle2;
  }
  const Mat3<S> k = hat(phi);
  return Mat3<S>::Identity() - k / 2 + c * k * k;
}

template <Scalar S>
struct SE3 {
  using ScalarType = S;
  using Tangent = Vec6<S>;
  static constexpr int kDof = 6;

  SO3<S> rotation;
  Vec3<S> translation = Vec3<S>::Zero();

  [[nodiscard]] static SE3 exp(const Vec6<S>& xi) noexcept {
    const Vec3<S> phi = xi.template head<3>();
    return {SO3<S>::exp(phi), left_jacobian(phi) * xi.template tail<3>()};
  }
  [[nodiscard]] Vec6<S> log() const noexcept {
    const Vec3<S> phi = rotation.log();
    Vec6<S> xi;
    xi << phi, left_jacobian_inverse(phi) * translation;
    return xi;
  }
  [[nodiscard]] SE3 inverse() const noexcept {
    const SO3<S> r = rotation.inverse();
    return {r, -(r * translation)};
  }
  [[nodiscard]] SE3 operator*(const SE3& other) const noexcept {
    return {rotation * other.rotation, rotation * other.translation + translation};
  }
  [[nodiscard]] Vec3<S> operator*(const Vec3<S>& x) const noexcept { return rotation * x + translation; }

  // Exp(xi) times this.
  [[nodiscard]] SE3 retract(const Vec6<S>& xi) const noexcept { return exp(xi) * *this; }

  template <Scalar T>
  [[nodiscard]] SE3<T> cast() const noexcept {
    return {rotation.template cast<T>(), translation.template cast<T>()};
  }
};

}  // namespace sslam
