// SPDX-License-Identifier: BSD-3-Clause
// The 24 rotations that map a cube to itself. A Manhattan frame is determined up to these.
#pragma once

#include <Eigen/Core>

#include "sslam/geometry/so3.hpp"

namespace sslam {

// The signed permutation of the axes, determinant +1, that brings a rotation closest to the identity when
// multiplied from the right: R * nearest_cube_rotation(R^-1) has the largest trace of all 24.
template <Scalar S>
[[nodiscard]] Mat3<S> nearest_cube_rotation(const Mat3<S>& rotation) noexcept {
  constexpr int kPermutations[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  S best_score = S(-4);
  Mat3<S> best = Mat3<S>::Identity();
  for (int p = 0; p < 6; ++p) {
    for (int signs = 0; signs < 4; ++signs) {
      const S first = (signs & 1) != 0 ? S(-1) : S(1);
      const S second = (signs & 2) != 0 ? S(-1) : S(1);
      const S parity = p < 3 ? S(1) : S(-1);
      const S sign[3] = {first, second, parity * first * second};
      S score = 0;
      for (int c = 0; c < 3; ++c) score += sign[c] * rotation(kPermutations[p][c], c);
      if (score <= best_score) continue;
      best_score = score;
      best.setZero();
      for (int c = 0; c < 3; ++c) best(kPermutations[p][c], c) = sign[c];
    }
  }
  return best;
}

// The same three axes, with the names and signs that make the rotation closest to the prior.
template <Scalar S>
[[nodiscard]] SO3<S> closest_naming(const SO3<S>& cam_from_manhattan, const SO3<S>& prior) noexcept {
  const Mat3<S> manhattan_from_prior = (cam_from_manhattan.inverse() * prior).matrix();
  return SO3<S>::from_matrix(cam_from_manhattan.matrix() * nearest_cube_rotation(manhattan_from_prior));
}

// Angle between two frames whose axes have no names: the smallest over the 24 ways to name them, radians.
template <Scalar S>
[[nodiscard]] S angle_between_frames(const SO3<S>& a, const SO3<S>& b) noexcept {
  return angle_between(closest_naming(a, b), b);
}

}  // namespace sslam
