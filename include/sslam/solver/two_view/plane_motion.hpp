// SPDX-License-Identifier: BSD-3-Clause
// Motion induced by a plane: where rotation and normal are known, the translation over the plane's distance
// is linear in point matches, its length included; three unknowns, two equations a match.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "sslam/core/random.hpp"
#include "sslam/core/status.hpp"
#include "sslam/geometry/so3.hpp"
#include "sslam/solver/least_squares/positive_inverse.hpp"
#include "sslam/solver/two_view/epipolar.hpp"
#include "sslam/solver/two_view/stratified_sample.hpp"

namespace sslam {

template <Scalar S>
struct PlaneMotionOptions {
  S max_error = 3;              // of an inlier, standard deviations of its transfer error
  S min_inlier_share = S(0.5);  // of the matches that may lie on the plane: else kNoConsensus
  int min_inliers = 6;
  S max_sigma = S(0.1);  // standard deviation of t/d, all directions together: more is kDegenerate
  int max_samples = 60;  // pairs of matches tried
};

template <Scalar S>
struct PlaneMotion {
  Status status = Status::kTooFew;
  Vec3<S> t_10_over_d = Vec3<S>::Zero();
  Mat3<S> covariance = Mat3<S>::Zero();  // of t_10_over_d
  int inliers = 0;
};

namespace detail {

// x1 ~ R x0 + c tau with c = n . x0 and tau = t / d: the plane n . X0 = d > 0 gives X0 the depth d / c, and
// the homography is H = R + t n^T / d (Hartley and Zisserman, Multiple View Geometry, 2004, eq. 13.2, with
// the sign of d turned).
template <Scalar S>
struct PlaneTransfer {
  Vec3<S> turned;  // R x0
  Vec2<S> seen;    // x1
  S rate;          // c
  S sigma;         // of a coordinate of the transfer error, both images' noise

  // False for a ray that does not meet the plane in front of camera 0.
  [[nodiscard]] static bool make(const BearingMatch<S>& match, const Mat3<S>& R_10, const Vec3<S>& n_0,
                                 PlaneTransfer& out) noexcept {
    out.rate = n_0.dot(match.ray0);
    if (!(out.rate > S(0.02) * match.ray0.norm())) return false;
    out.turned = R_10 * match.ray0;
    out.seen = match.ray1.template head<2>();
    out.sigma = match.sigma * std::sqrt(S(2));
    return true;
  }

  // Squared error in standard deviations; infinite behind camera 1.
  [[nodiscard]] S squared_error(const Vec3<S>& tau) const noexcept {
    const Vec3<S> y = turned + rate * tau;
    if (!(y.z() > S(1e-3))) return std::numeric_limits<S>::infinity();
    return (y.template head<2>() / y.z() - seen).squaredNorm() / (sigma * sigma);
  }
};

// Least squares over  y_x - u y_z = 0,  y_y - v y_z = 0,  y = R x0 + c tau: linear in tau, and the transfer
// error times y_z, which the weight takes out.
template <Scalar S>
struct PlaneMotionEquations {
  Mat3<S> H = Mat3<S>::Zero();
  Vec3<S> g = Vec3<S>::Zero();
  S by_noise = 0;  // what noise of the seen coordinates alone adds along the viewing direction

  void add(const PlaneTransfer<S>& match, const Vec3<S>& tau, S robust) noexcept {
    const S z = match.turned.z() + match.rate * tau.z();
    const S weight = robust / (match.sigma * match.sigma * z * z);
    for (int i = 0; i < 2; ++i) {
      Vec3<S> row = Vec3<S>::Zero();
      row[i] = match.rate;
      row.z() = -match.seen[i] * match.rate;
      const S right = match.seen[i] * match.turned.z() - match.turned[i];
      H += weight * row * row.transpose();
      g += weight * right * row;
    }
    by_noise += weight * match.rate * match.rate * match.sigma * match.sigma;
  }
  // Whether every direction stands clear of the noise.
  [[nodiscard]] bool observable() const noexcept {
    Mat3<S> unused;
    return inverse_root<S, 3>(H - 3 * by_noise * Mat3<S>::Identity(), unused);
  }
  [[nodiscard]] bool solve(Vec3<S>& tau, Mat3<S>& covariance) const noexcept {
    if (!inverse_of<S, 3>(H, covariance)) return false;
    const Vec3<S> solved = covariance * g;
    if (!solved.allFinite()) return false;
    tau = solved;
    return true;
  }
};

}  // namespace detail

// t_10 / d from matches on one plane, n_0 . X0 = d with d > 0 in camera 0, where R_10 and n_0 are known;
// matches off the plane are told apart. `inliers` (empty, or one flag a match) is written on success alone.
// The same seed gives the same answer.
template <Scalar S>
[[nodiscard]] PlaneMotion<S> plane_motion(std::span<const BearingMatch<S>> matches, const SO3<S>& R_10,
                                          const Vec3<S>& n_0, const PlaneMotionOptions<S>& options,
                                          std::uint64_t seed, std::span<std::uint8_t> inliers = {}) noexcept {
  using Transfer = detail::PlaneTransfer<S>;
  PlaneMotion<S> motion;
  const Mat3<S> R = R_10.matrix();
  const auto refuse = [&](Status status) {
    motion.status = status;
    return motion;
  };
  if (!R.allFinite() || !n_0.allFinite() || !all_finite(matches)) return refuse(Status::kNotFinite);
  const S gate = options.max_error * options.max_error;
  // Calls visit(match, error) for the matches that may lie on the plane; their number.
  const auto for_each = [&](const Vec3<S>& tau, auto visit) {
    Transfer t;
    int count = 0;
    for (const BearingMatch<S>& match : matches)
      if (Transfer::make(match, R, n_0, t)) visit(t, t.squared_error(tau)), ++count;
    return count;
  };
  const auto agreeing = [&](const Vec3<S>& tau) {
    int count = 0;
    for_each(tau, [&](const Transfer&, S error) { count += error < gate ? 1 : 0; });
    return count;
  };
  Vec3<S> best = Vec3<S>::Zero();
  const int candidates = for_each(best, [](const Transfer&, S) {});
  if (candidates < options.min_inliers) return motion;
  int most = agreeing(best);
  Random random(seed);
  for (int sample = 0; sample < options.max_samples && most < candidates; ++sample) {
    detail::PlaneMotionEquations<S> two;
    Transfer t;
    bool good = true;
    for (std::size_t slot = 0; slot < 2 && good; ++slot) {
      good = Transfer::make(matches[stratified_index(slot, 2, matches.size(), random)], R, n_0, t);
      if (good) two.add(t, Vec3<S>::Zero(), S(1));
    }
    Vec3<S> tau;
    Mat3<S> unused;
    if (!good || !two.solve(tau, unused)) continue;
    const int count = agreeing(tau);
    if (count > most) most = count, best = tau;
  }
  for (int round = 0; round < 5; ++round) {
    detail::PlaneMotionEquations<S> equations;
    for_each(best, [&](const Transfer& match, S error) {
      const S left = 1 - error / (2 * gate);  // Tukey's biweight, a little wider than the gate
      if (left > 0) equations.add(match, best, left * left);
    });
    if (!equations.observable() || !equations.solve(best, motion.covariance))
      return refuse(Status::kDegenerate);
  }
  motion.inliers = agreeing(best);
  motion.t_10_over_d = best;
  if (motion.inliers < options.min_inliers ||
      static_cast<S>(motion.inliers) < options.min_inlier_share * static_cast<S>(candidates))
    return refuse(Status::kNoConsensus);
  if (!(motion.covariance.trace() < options.max_sigma * options.max_sigma))
    return refuse(Status::kDegenerate);
  if (inliers.size() == matches.size()) {
    Transfer t;
    for (std::size_t i = 0; i < matches.size(); ++i)
      inliers[i] = Transfer::make(matches[i], R, n_0, t) && t.squared_error(best) < gate;
  }
  return refuse(Status::kOk);
}

}  // namespace sslam
