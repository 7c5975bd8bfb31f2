// SPDX-License-Identifier: BSD-3-Clause
// Flow: what a match moves by once the rotation is taken out. Along the ray to the epipole it is parallax,
// across it is noise; so it is linear in the direction of translation.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "sslam/solver/least_squares/positive_inverse.hpp"
#include "sslam/solver/two_view/epipolar.hpp"

namespace sslam {

template <Scalar S>
struct Flow {
  Vec3<S> normal;    // R_10 x0 x x1 of rays with z = 1: (-flow.y, flow.x, u0 v1 - v0 u1)
  Vec2<S> midpoint;  // between the rotated and the seen point, image plane 1
  S weight;          // inverse variance of a coordinate of the flow

  [[nodiscard]] S squared_length() const noexcept { return normal.template head<2>().squaredNorm(); }
};

// Vector in the image plane along which parallax moves a point at `midpoint`: t - t_z x, at unit depth.
template <Scalar S>
[[nodiscard]] Vec2<S> epipolar_direction(const Flow<S>& flow, const Vec3<S>& t_10) noexcept {
  return t_10.template head<2>() - t_10.z() * flow.midpoint;
}

// False when the rotated ray does not meet image plane 1. rotation_sigma (rad) is the uncertainty of R_10
// about each axis: it moves points as noise does.
template <Scalar S>
[[nodiscard]] bool compensate(const Mat3<S>& R_10, const BearingMatch<S>& match, S rotation_sigma,
                              Flow<S>& flow) noexcept {
  const Vec3<S> rotated = R_10 * match.ray0;
  if (!(rotated.z() > S(0.1))) return false;
  const S inverse_z = 1 / rotated.z();
  const Vec3<S> x0 = rotated * inverse_z;
  flow.normal = x0.cross(match.ray1);
  flow.midpoint = (x0 + match.ray1).template head<2>() / 2;
  // The rotation stretches areas of the image plane by z^-3, and so the noise of x0.
  const S stretch = inverse_z * inverse_z * inverse_z;
  flow.weight = 1 / (match.sigma * match.sigma * (1 + stretch) + rotation_sigma * rotation_sigma);
  return true;
}

// Squared distance of the flow from the epipolar half-line (what lies before it is behind a camera), in
// variances. 0.5 stands for the second order of the noise: it keeps the quotient finite at the epipole.
template <Scalar S>
[[nodiscard]] S squared_error(const Flow<S>& flow, const Vec3<S>& t_10) noexcept {
  const Vec2<S> along = epipolar_direction(flow, t_10);
  const S across = flow.normal.dot(t_10) * flow.weight;
  const S moved = (flow.normal.y() * along.x() - flow.normal.x() * along.y()) * flow.weight;
  const S behind = std::min(moved, S(0));
  return (across * across + behind * behind) / (flow.weight * along.squaredNorm() + S(0.5));
}

// The two parts of that error before squaring, in standard deviations; along > 0 in front of both cameras.
template <Scalar S>
struct EpipolarFit {
  S across, along;
  S unit;  // `along` of a point whose depth is one baseline
};

template <Scalar S>
[[nodiscard]] EpipolarFit<S> epipolar_fit(const Flow<S>& flow, const Vec3<S>& t_10) noexcept {
  const Vec2<S> along = epipolar_direction(flow, t_10);
  const S moved = flow.normal.y() * along.x() - flow.normal.x() * along.y();
  const S squared_length = flow.weight * along.squaredNorm();
  const S scale = flow.weight / std::sqrt(squared_length + S(0.5));
  return {flow.normal.dot(t_10) * scale, moved * scale, squared_length * scale / flow.weight};
}

template <Scalar S>
struct FlowSolution {
  Vec3<S> best, rival;  // unit directions of either sign with the least and the second least error
  Vec3<S> eigenvalues;  // ascending, 1 where there is nothing but noise
};

// The linear system  normal_i . t = 0, its rows as long as the parallax, and the share that noise has in its
// normal matrix. Solving  M t = lambda N t  instead of taking the plain null vector removes the bias towards
// the viewing direction (renormalisation: Kanatani, Statistical Optimization, 1996, ch. 9).
template <Scalar S>
struct FlowSystem {
  Mat3<S> measured = Mat3<S>::Zero();  // lower triangles
  Mat3<S> noise = Mat3<S>::Zero();
  int count = 0;

  void add(const Flow<S>& flow) noexcept {
    const Vec3<S> row = flow.weight * flow.normal;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j) measured(i, j) += row(i) * flow.normal(j);
    noise(0, 0) += 1;
    noise(2, 0) -= flow.midpoint.x();
    noise(2, 1) -= flow.midpoint.y();
    noise(2, 2) += flow.midpoint.squaredNorm();
    ++count;
  }

  // False when singular.
  [[nodiscard]] bool solve(FlowSolution<S>& solution) const noexcept {
    if (count < 2) return false;
    Mat3<S> n = noise;
    n(1, 1) = n(0, 0);
    n.diagonal().array() += S(1e-5) * n.trace();
    Mat3<S> whitening;  // L^-1 of n = L L^T
    if (!inverse_root<S, 3>(n, whitening)) return false;
    const Mat3<S> m = measured.template selfadjointView<Eigen::Lower>();
    const Eigen::SelfAdjointEigenSolver<Mat3<S>> eigen(whitening * m * whitening.transpose());
    if (eigen.info() != Eigen::Success) return false;
    const Mat3<S> directions = whitening.transpose() * eigen.eigenvectors();
    solution = {directions.col(0).normalized(), directions.col(1).normalized(), eigen.eigenvalues()};
    return solution.best.allFinite() && solution.rival.allFinite();
  }
};

}  // namespace sslam
