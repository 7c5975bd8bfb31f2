// SPDX-License-Identifier: BSD-3-Clause
// Rigid motions: rotation and translation, with tangent xi = (phi, rho), rotation first, perturbed on the
// left.
#pragma once

#include "sslam/geometry/so3.hpp"

namespace sslam {

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

  // Moves a tangent vector from the right to the left: T Exp(xi) = Exp(adjoint xi) T.
  [[nodiscard]] Mat6<S> adjoint() const noexcept {
    const Mat3<S> r = rotation.matrix();
    Mat6<S> m;
    m << r, Mat3<S>::Zero(), hat(translation) * r, r;
    return m;
  }

  // Exp(xi) times this.
  [[nodiscard]] SE3 retract(const Vec6<S>& xi) const noexcept { return exp(xi) * *this; }

  template <Scalar T>
  [[nodiscard]] SE3<T> cast() const noexcept {
    return {rotation.template cast<T>(), translation.template cast<T>()};
  }
};
static_assert(Manifold<SE3<float>> && Manifold<SE3<double>>);

}  // namespace sslam
