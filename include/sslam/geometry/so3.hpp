// SPDX-License-Identifier: BSD-3-Clause
// Rotations in three dimensions as unit quaternions, with exponential, logarithm, left perturbation and its
// Jacobian.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "sslam/geometry/manifold.hpp"

namespace sslam {

// The matrix of the cross product: hat(a) b = a x b.
template <Scalar S>
[[nodiscard]] inline Mat3<S> hat(const Vec3<S>& a) noexcept {
  Mat3<S> m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

template <Scalar S>
class SO3 {
 public:
  using ScalarType = S;
  using Tangent = Vec3<S>;
  static constexpr int kDof = 3;

  SO3() noexcept : q_(1, 0, 0, 0) {}

  // Rodrigues' formula; phi = angle times unit axis, radians.
  [[nodiscard]] static SO3 exp(const Vec3<S>& phi) noexcept {
    const S angle2 = phi.squaredNorm();
    // sin(angle / 2) / angle and cos(angle / 2), by series where the quotient would lose digits.
    S scale = S(0.5) - angle2 / 48;
    S w = 1 - angle2 / 8 + angle2 * angle2 / 384;
    if (angle2 > S(1e-4)) {
      const S angle = std::sqrt(angle2);
      scale = std::sin(angle / 2) / angle;
      w = std::cos(angle / 2);
    } else {
      scale += angle2 * angle2 / 3840;
    }
    return SO3(Eigen::Quaternion<S>(w, scale * phi.x(), scale * phi.y(), scale * phi.z()).normalized());
  }

  // Inverse of exp with an angle in [0, pi].
  [[nodiscard]] Vec3<S> log() const noexcept {
    const S sign = q_.w() < 0 ? S(-1) : S(1);
    const Vec3<S> v = sign * q_.vec();
    const S w = sign * q_.w();
    const S sine = v.norm();
    // 2 atan2(sine, w) / sine; for small angles atan(x) = x - x^3 / 3.
    const S scale = sine > S(1e-4) ? 2 * std::atan2(sine, w) / sine : (2 - 2 * sine * sine / (3 * w * w)) / w;
    return scale * v;
  }

  // m must be a rotation matrix; for other matrices, see nearest_rotation.
  [[nodiscard]] static SO3 from_matrix(const Mat3<S>& m) noexcept {
    return SO3(Eigen::Quaternion<S>(m).normalized());
  }
  [[nodiscard]] static SO3 from_quaternion(S w, S x, S y, S z) noexcept {
    return SO3(Eigen::Quaternion<S>(w, x, y, z).normalized());
  }

  [[nodiscard]] Mat3<S> matrix() const noexcept { return q_.toRotationMatrix(); }
  [[nodiscard]] const Eigen::Quaternion<S>& quaternion() const noexcept { return q_; }
  [[nodiscard]] SO3 inverse() const noexcept { return SO3(q_.conjugate()); }
  [[nodiscard]] SO3 operator*(const SO3& other) const noexcept { return SO3((q_ * other.q_).normalized()); }
  [[nodiscard]] Vec3<S> operator*(const Vec3<S>& v) const noexcept { return q_ * v; }

  // Exp(delta) times this.
  [[nodiscard]] SO3 retract(const Vec3<S>& delta) const noexcept { return exp(delta) * *this; }

  template <Scalar T>
  [[nodiscard]] SO3<T> cast() const noexcept {
    return SO3<T>::from_quaternion(static_cast<T>(q_.w()), static_cast<T>(q_.x()), static_cast<T>(q_.y()),
                                   static_cast<T>(q_.z()));
  }

 private:
  explicit SO3(const Eigen::Quaternion<S>& q) noexcept : q_(q) {}
  Eigen::Quaternion<S> q_;
};
static_assert(Manifold<SO3<float>> && Manifold<SO3<double>>);

// Angle between two rotations, radians in [0, pi].
template <Scalar S>
[[nodiscard]] S angle_between(const SO3<S>& a, const SO3<S>& b) noexcept {
  return (a * b.inverse()).log().norm();
}

// Exp(phi + d) = Exp(J d) Exp(phi) to first order. J is the integral of Exp(s phi) over s in [0, 1], so it
// also maps rho to the translation of Exp(phi, rho) (Barfoot, State Estimation for Robotics, 2017,
// section 7.1).
template <Scalar S>
[[nodiscard]] Mat3<S> left_jacobian(const Vec3<S>& phi) noexcept {
  const S angle2 = phi.squaredNorm();
  S a = S(0.5) - angle2 / 24 + angle2 * angle2 / 720;      // (1 - cos) / angle^2
  S b = S(1) / 6 - angle2 / 120 + angle2 * angle2 / 5040;  // (angle - sin) / angle^3
  if (angle2 > S(1e-3)) {
    const S angle = std::sqrt(angle2);
    const S half = std::sin(angle / 2);
    a = 2 * half * half / angle2;
    b = (angle - std::sin(angle)) / (angle2 * angle);
  }
  const Mat3<S> k = hat(phi);
  return Mat3<S>::Identity() + a * k + b * k * k;
}

// Log(Exp(d) Exp(phi)) = phi + J^-1 d to first order; |phi| below 2 pi.
template <Scalar S>
[[nodiscard]] Mat3<S> left_jacobian_inverse(const Vec3<S>& phi) noexcept {
  const S angle2 = phi.squaredNorm();
  S c = S(1) / 12 + angle2 / 720 + angle2 * angle2 / 30240;
  if (angle2 > S(1e-3)) {
    const S angle = std::sqrt(angle2);
    c = (1 - (angle / 2) / std::tan(angle / 2)) / angle2;
  }
  const Mat3<S> k = hat(phi);
  return Mat3<S>::Identity() - k / 2 + c * k * k;
}

}  // namespace sslam
