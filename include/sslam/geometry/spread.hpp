// SPDX-License-Identifier: BSD-3-Clause
// The spread of a quantity of three components, from its covariance.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "sslam/core/types.hpp"

namespace sslam {

// Eigenvalues of a symmetric matrix, ascending; in closed form, to about eight digits in double.
template <Scalar S>
[[nodiscard]] Vec3<S> symmetric_eigenvalues(const Mat3<S>& symmetric) {
  Eigen::SelfAdjointEigenSolver<Mat3<S>> solver;
  solver.computeDirect(symmetric, Eigen::EigenvaluesOnly);
  return solver.eigenvalues();
}

// The standard deviation along the direction, or about the axis, in which it is largest; NaN stays NaN.
template <Scalar S>
[[nodiscard]] S largest_sigma(const Mat3<S>& covariance) {
  return std::sqrt(std::max(symmetric_eigenvalues<S>(covariance).z(), S(0)));
}

}  // namespace sslam
