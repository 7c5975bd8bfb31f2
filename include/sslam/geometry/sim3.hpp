// SPDX-License-Identifier: BSD-3-Clause
// Similarities: rotation, translation and scale, x' = s R x + t, with tangent (phi, rho, log s), perturbed on
// the left.
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
    return {rotation * other.rotation, scale * (rotation * other.translation) + translation,
            scale * other.scale};
  }
  [[nodiscard]] Vec3<S> operator*(const Vec3<S>& x) const noexcept {
    return scale * (rotation * x) + translation;
  }

  // Exp(xi) times this.
  [[nodiscard]] Sim3 retract(const Vec<S, 7>& xi) const noexcept { return exp(xi) * *this; }

  // Moves a tangent vector from the right to the left: this * Exp(xi) = Exp(adjoint() * xi) * this.
  [[nodiscard]] Mat<S, 7, 7> adjoint() const noexcept {
    const Mat3<S> r = rotation.matrix();
    Mat<S, 7, 7> a = Mat<S, 7, 7>::Zero();
    a.template block<3, 3>(0, 0) = r;
    a.template block<3, 3>(3, 0) = hat(translation) * r;
    a.template block<3, 3>(3, 3) = scale * r;
    a.template block<3, 1>(3, 6) = -translation;
    a(6, 6) = 1;
    return a;
  }

  // Log(Exp(delta) * Exp(xi)) = xi + left_jacobian_inverse(xi) * delta for small delta: the first terms of
  // Bernoulli's series in the bracket of xi. Its entries are exact to 2e-6 for angles up to half a radian and
  // scales up to e, to 2e-5 for angles up to one radian.
  [[nodiscard]] static Mat<S, 7, 7> left_jacobian_inverse(const Vec<S, 7>& xi) noexcept {
    Mat<S, 7, 7> bracket = Mat<S, 7, 7>::Zero();
    bracket.template block<3, 3>(0, 0) = hat<S>(xi.template head<3>());
    bracket.template block<3, 3>(3, 0) = hat<S>(xi.template segment<3>(3));
    bracket.template block<3, 3>(3, 3) = bracket.template block<3, 3>(0, 0) + xi[6] * Mat3<S>::Identity();
    bracket.template block<3, 1>(3, 6) = -xi.template segment<3>(3);
    const Mat<S, 7, 7> square = bracket * bracket;
    const Mat<S, 7, 7> fourth = square * square;
    return Mat<S, 7, 7>::Identity() - bracket / 2 + square / 12 - fourth / 720 + fourth * square / 30240;
  }

 private:
  // Integral over s in [0, 1] of e^(s sigma) Exp(s phi): maps rho to the translation (Strasdat, thesis 2012,
  // 2.5.3). By Gauss-Legendre quadrature with ten nodes. It is exact to rounding for angles up to pi and
  // scales up to a hundred, without the cancellations of the closed form at small angles or scales near 1.
  [[nodiscard]] static Mat3<S> drift(const Vec3<S>& phi, S sigma) noexcept {
    constexpr double kNode[] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                                0.8650633666889845, 0.9739065285171717};
    constexpr double kWeight[] = {0.2955242247147529, 0.2692667193099963, 0.2190863625159820,
                                  0.1494513491505806, 0.0666713443086881};
    const S angle = phi.norm();
    // The integrals of e^(s sigma) times 1, sin(s angle) / angle and (1 - cos(s angle)) / angle^2.
    S c = 0, a = 0, b = 0;
    for (int i = 0; i < 10; ++i) {
      const S s = S(0.5 + (i % 2 == 0 ? 0.5 : -0.5) * kNode[i / 2]);
      const S w = S(0.5 * kWeight[i / 2]) * std::exp(s * sigma);
      const S half = s * sinc(s * angle / 2);
      c += w;
      a += w * s * sinc(s * angle);
      b += w * half * half / 2;
    }
    const Mat3<S> k = hat(phi);
    return c * Mat3<S>::Identity() + a * k + b * k * k;
  }
  [[nodiscard]] static S sinc(S x) noexcept { return x > S(1e-4) ? std::sin(x) / x : 1 - x * x / 6; }
};
static_assert(Manifold<Sim3<float>> && Manifold<Sim3<double>>);

// The motion as a similarity of scale 1.
template <Scalar S>
[[nodiscard]] Sim3<S> similarity(const SE3<S>& motion) noexcept {
  return {motion.rotation, motion.translation, 1};
}

}  // namespace sslam
