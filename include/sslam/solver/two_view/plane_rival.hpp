// SPDX-License-Identifier: BSD-3-Clause
// The second interpretation of a flat scene: two relative poses explain the same homography of one plane, and
// near a plane the wrong one is a deep local minimum. Given one, this makes a start near the other.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <span>

#include "sslam/solver/two_view/flow_sample.hpp"
#include "sslam/solver/two_view/relative_pose.hpp"

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

// The other motion with the homography  H = R + t n^T R  of a plane in front of both cameras (Ma, Soatto,
// Kosecka and Sastry, An Invitation to 3-D Vision, 2004, sec. 5.3). False when H is a rotation, which has no
// other.
template <Scalar S>
[[nodiscard]] bool plane_rival(const RelativePose<S>& pose, const Vec3<S>& n,
                               RelativePose<S>& rival) noexcept {
  const Mat3<S> R = pose.R_10.matrix();
  Mat3<S> H = R + pose.t_10 * (R.transpose() * n).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3<S>> eigen(H.transpose() * H);
  const Vec3<S> squares = eigen.eigenvalues() / eigen.eigenvalues()[1];  // of the singular values, ascending
  H /= std::sqrt(eigen.eigenvalues()[1]);
  const S below = std::max(1 - squares[0], S(0)), above = std::max(squares[2] - 1, S(0));
  if (!(eigen.eigenvalues()[0] > 0) || !(below + above > S(1e-5))) return false;
  const Vec3<S> v2 = eigen.eigenvectors().col(1);
  S agreement = 2;
  for (const S sign : {S(1), S(-1)}) {
    const Vec3<S> u = (std::sqrt(below) * eigen.eigenvectors().col(2) +
                       sign * std::sqrt(above) * eigen.eigenvectors().col(0)) /
                      std::sqrt(below + above);
    Vec3<S> normal = v2.cross(u);
    Mat3<S> from, to;
    from << v2, u, normal;
    to << H * v2, H * u, (H * v2).cross(H * u);
    const Mat3<S> turn = to * from.transpose();
    if (normal.z() < 0) normal = -normal;
    const Vec3<S> t = (H - turn) * normal;
    const S length = t.norm();
    if (!(length > 0) || !(t.dot(pose.t_10) / length < agreement)) continue;
    agreement = t.dot(pose.t_10) / length;
    rival = {SO3<S>::from_matrix(turn), t / length};
  }
  return agreement < 2 && rival.t_10.allFinite() && rival.R_10.matrix().allFinite();
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
