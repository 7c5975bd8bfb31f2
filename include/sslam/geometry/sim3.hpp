// SPDX-License-Identifier: BSD-3-Clause
// Similarities: rotation, translation and scale, x' = s R x + t, with tangent (phi, rho, log s), perturbed on the left.
#pragma once

#include <Eigen/LU>
#include <cmath>

#include "sslam/geometry/se3.hpp"

namespace sslam {

template <Scalar S>
struct Sim3 {
  using ScalarType = S;
  using Tangent = Vec<S, 7>;
  static constexpr int kDof = 7;

  SO3<S> rotation;
  Vec3<S> translation = Vec3<S>::Zero();
  S scale = 1;

  [[nodiscard]] static Sim3 exp(const Vec<S, 7>& xi) noexcept {
    const Vec3<S> phi = xi.template head<3>();
    return {SO3<S>::exp(phi), drift(phi, xi[6]) * xi.template segment<3>(3), std::exp(xi[6])};
  }
  [[nodiscard]] Vec<S, 7> log() const noexcept {
    Vec<S, 7> xi;
    const Vec3<S> phi = rotation.log();
    const S sigma = std::log(scale);
    xi << phi, drift(phi, sigma).inverse() * translation, sigma;
    return xi;
  }
  [[nodiscard]] Sim3 inverse() const noexcept {
    const SO3<S> r = rotation.inverse();
    return {r, -(r * translation) / scale, 1 / scale};
  }
  [[nodiscard]] Sim3 operator*(const Sim3& other) const noexcept {
    return {rotation * other.rotation, scale * (rotation * other.translation) + translation, scale * other.scale};
  }
  [[nodiscard]] Vec3<S> operator*(const Vec3<S>& x) const noexcept { return scale * (rotation * x) + translation; }

  // Exp(xi) times this.
  [[nodiscard]] Sim3 retract(const Vec<S, 7>& xi) const noexcept { return exp(xi) * *this; }

 private:
  // Integral over s in [0, 1] of e^(s sigma) Exp(s phi): takes rho to the translation (Strasdat, thesis 2012, 2.5.3).
  [[nodiscard]] static Mat3<S> drift(const Vec3<S>& phi, S sigma) noexcept {
    const S angle2 = phi.squaredNorm();
    const Mat3<S> k = hat(phi);
    // The integrals of e^(s sigma) times 1, sin(s a) / a and (1 - cos(s a)) / a^2.
    const S small = S(1e-3);
    if (std::abs(sigma) < small && angle2 < small) {
      const S c = 1 + sigma / 2 + sigma * sigma / 6;
      const S a = S(0.5) + sigma / 3 + sigma * sigma / 8 - angle2 / 24;
      const S b = S(1) / 6 + sigma / 8 + sigma * sigma / 20 - angle2 / 120;
      return c * Mat3<S>::Identity() + a * k + b * k * k;
    }
    const S e = std::exp(sigma);
    const S c = std::abs(sigma) < small ? 1 + sigma / 2 + sigma * sigma / 6 : std::expm1(sigma) / sigma;
    if (angle2 < small) {
      // Moments of s and s^2 under e^(s sigma).
      const S m1 = (e - c) / sigma, m2 = (e - 2 * m1) / sigma;
      const S m3 = (e - 3 * m2) / sigma, m4 = (e - 4 * m3) / sigma;
      return c * Mat3<S>::Identity() + (m1 - angle2 * m3 / 6) * k + (m2 / 2 - angle2 * m4 / 24) * k * k;
    }
    const S angle = std::sqrt(angle2);
    const S norm2 = sigma * sigma + angle2;
    const S sine = e * std::sin(angle), cosine = e * std::cos(angle);
    const S int_sin = (sigma * sine - angle * (cosine - 1)) / norm2;
    const S int_cos = (sigma * (cosine - 1) + angle * sine) / norm2;
    return c * Mat3<S>::Identity() + int_sin / angle * k + (c - int_cos) / angle2 * k * k;
  }
};

}  // namespace sslam
