// SPDX-License-Identifier: BSD-3-Clause
// The second interpretation of a flat scene: two relative poses explain the same homography of one plane, and
// near a plane the wrong one is a deep local minimum. Given one, this makes a start near the other.
#pragma once

#include <Eigen/Cholesky>
#include <cmath>
#include <span>

#include "sslam/solver/flow_sample.hpp"
#include "sslam/solver/relative_pose.hpp"

namespace sslam {

// n with  n . R x0 = 1 / depth  over the inliers of a pose (frame 1, per baseline): the plane of most of the
// scene. Returns the share of the inliers that it explains.
template <Scalar S>
[[nodiscard]] S scene_plane(std::span<const BearingMatch<S>> matches, const RelativePose<S>& pose,
                            const FlowGate<S>& gate, Vec3<S>& n) noexcept {
  const Mat3<S> R = pose.R_10.matrix();
  Flow<S> flow;
  n.setZero();
  S inliers = 0, explained = 0;
  for (int round = 0; round < 3; ++round) {
    Mat3<S> a = Mat3<S>::Zero();
    Vec3<S> b = Vec3<S>::Zero();
    inliers = explained = 0;
    for (const BearingMatch<S>& match : matches) {
      if (!compensate(R, match, S(0), flow)) continue;
      const EpipolarFit<S> fit = epipolar_fit(flow, pose.t_10);
      if (!gate.accepts(fit)) continue;
      const Vec3<S> row = fit.unit * Vec3<S>(flow.midpoint.x(), flow.midpoint.y(), 1);
      const S error = std::abs(fit.along - row.dot(n));
      ++inliers;
      if (error < gate.max_error) ++explained;
      const S robust = round > 0 && error > 2 ? 2 / error : S(1);  // towards the plane of the majority
      a += robust * row * row.transpose();
      b += robust * fit.along * row;
    }
    const Eigen::LLT<Mat3<S>> factor(a);
    if (factor.info() != Eigen::Success) return 0;
    n = factor.solve(b);
  }
  return n.allFinite() && n.norm() > 0 ? explained / inliers : S(0);
}

// With H R^T = I + t n^T: the rival has translation and normal exchanged, I + t n^T ~ Exp(n x t) + n t^T,
// exact for small motion (Longuet-Higgins 1986 has the finite case).
template <Scalar S>
[[nodiscard]] RelativePose<S> plane_rival(const RelativePose<S>& pose, const Vec3<S>& n) noexcept {
  return {pose.R_10.retract(n.cross(pose.t_10)), n.normalized()};
}

// Truncated squared errors, summed over the matches, plus the prior of the options: what two poses are
// compared by.
template <Scalar S>
[[nodiscard]] S truncated_cost(std::span<const BearingMatch<S>> matches, const RelativePose<S>& pose,
                               const RelativePoseOptions<S>& options) noexcept {
  const Mat3<S> R = pose.R_10.matrix();
  const S outlier = options.max_error * options.max_error;
  const Vec3<S> phi = (pose.R_10 * options.prior_R_10.inverse()).log();
  S sum = phi.dot(options.prior_information * phi);
  Flow<S> flow;
  for (const BearingMatch<S>& match : matches)
    sum += compensate(R, match, S(0), flow) ? std::min(squared_error(flow, pose.t_10), outlier) : outlier;
  return sum;
}

}  // namespace sslam
