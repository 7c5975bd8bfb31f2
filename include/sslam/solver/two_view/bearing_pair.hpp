// SPDX-License-Identifier: BSD-3-Clause
// Matches as pairs of unit bearings, and the rotation that carries one bearing of each to the other: from two
// pairs, and by least squares.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "sslam/geometry/so3.hpp"
#include "sslam/solver/two_view/epipolar.hpp"

namespace sslam {

// Unit bearings, and the inverse variance of either coordinate of their difference on the sphere.
template <Scalar S>
struct BearingPair {
  Vec3<S> b0, b1;
  S weight;

  BearingPair() noexcept = default;
  explicit BearingPair(const BearingMatch<S>& match) noexcept {
    // The sphere shrinks areas of the image plane by the cube of the cosine, and so the noise.
    const S cos0 = 1 / match.ray0.norm(), cos1 = 1 / match.ray1.norm();
    b0 = match.ray0 * cos0;
    b1 = match.ray1 * cos1;
    weight = 1 / (match.sigma * match.sigma * (cos0 * cos0 * cos0 + cos1 * cos1 * cos1));
  }
  [[nodiscard]] S squared_error(const Mat3<S>& R_10) const noexcept {
    return weight * (b1 - R_10 * b0).squaredNorm();
  }
};

// Gauss-Newton on SO(3): with p = R b0, the error b1 - p has the derivative [p]x, and the normal matrix is
// sum w (I - p p^T).
template <Scalar S>
struct BearingEquations {
  Mat3<S> information = Mat3<S>::Zero();
  Vec3<S> torque = Vec3<S>::Zero();
  int count = 0;

  void add(const BearingPair<S>& pair, const Mat3<S>& R_10, S max_squared_error) noexcept {
    const S error = pair.squared_error(R_10);
    if (!(error < max_squared_error)) return;
    const S robust = error > S(2.25) ? S(1.5) / std::sqrt(error) : S(1);  // Huber
    const Vec3<S> p = R_10 * pair.b0;
    information += robust * pair.weight * (Mat3<S>::Identity() - p * p.transpose());
    torque += robust * pair.weight * p.cross(pair.b1);
    ++count;
  }

  [[nodiscard]] bool step(SO3<S>& R_10) const noexcept {
    const Eigen::LLT<Mat3<S>> factor(information);
    if (count < 2 || factor.info() != Eigen::Success) return false;
    const Vec3<S> phi = factor.solve(torque);
    if (!(phi.norm() < S(0.5))) return false;
    R_10 = R_10.retract(phi);
    return true;
  }
};

// The rotation that carries one pair of directions to another (TRIAD, symmetric in the two). False when the
// pairs are nearly parallel or do not include the same angle.
template <Scalar S>
[[nodiscard]] bool rotation_from_two(const BearingPair<S>& a, const BearingPair<S>& b, S max_error,
                                     SO3<S>& R_10) noexcept {
  const auto frame = [](const Vec3<S>& u, const Vec3<S>& v) {
    Mat3<S> columns;
    columns.col(0) = (u + v).normalized();
    columns.col(1) = u.cross(v).normalized();
    columns.col(2) = columns.col(0).cross(columns.col(1));
    return columns;
  };
  const S chord0 = (a.b0 - b.b0).norm(), chord1 = (a.b1 - b.b1).norm();
  constexpr S kLeastAngle = S(0.05);
  if (std::min(chord0, chord1) < kLeastAngle || std::max(chord0, chord1) > S(1.9)) return false;
  if (std::abs(chord0 - chord1) > max_error * std::sqrt(1 / a.weight + 1 / b.weight)) return false;
  R_10 = SO3<S>::from_matrix(frame(a.b1, b.b1) * frame(a.b0, b.b0).transpose());
  return true;
}

}  // namespace sslam
