// SPDX-License-Identifier: BSD-3-Clause
// Refinement of a relative pose (rotation and direction of translation, 5 degrees of freedom) over the
// epipolar errors of matches, robust to mismatches, with an optional prior on the rotation.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "sslam/core/status.hpp"
#include "sslam/solver/least_squares/positive_inverse.hpp"
#include "sslam/solver/two_view/epipolar_problem.hpp"

namespace sslam {

template <Scalar S>
struct RelativePoseSummary {
  Status status = Status::kTooFew;
  Mat3<S> rotation_covariance = Mat3<S>::Zero();     // of the left perturbation of R_10, rad^2
  Mat3<S> translation_covariance = Mat3<S>::Zero();  // of t_10, of rank 2, rad^2
  S parallax = 0;                                    // median over the inliers, rad
  S mean_squared_error = 0;  // of the inliers, variances: about 1 when the noise is as stated
  int inliers = 0;
};

namespace detail {

template <Scalar S>
struct RelativePoseTally {
  NormalEquations<S, 5> equations;
  Mat2<S> noise = Mat2<S>::Zero();
  S squared_error = 0, moved = 0, count = 0;
};

template <Scalar S>
[[nodiscard]] RelativePoseTally<S> tally(std::span<const BearingMatch<S>> matches,
                                         const EpipolarProblem<S>& problem, const RelativePose<S>& pose,
                                         S min_parallax) noexcept {
  const Mat3<S> R = pose.R_10.matrix();
  const Mat<S, 3, 2> basis = tangent_basis(pose.t_10);
  RelativePoseTally<S> sum;
  (void)problem(pose, sum.equations);
  sum.equations.complete();
  Flow<S> flow;
  for (const BearingMatch<S>& match : matches) {
    if (!problem.accepts(match) || !compensate(R, match, S(0), flow)) continue;
    const S r = epipolar_residual(R, pose.t_10, match);
    sum.squared_error += r * r;
    if (flow.weight * flow.squared_length() > min_parallax * min_parallax) ++sum.moved;
    sum.noise += EpipolarProblem<S>::kLoss.weight(r * r) * epipolar_row_noise(R, pose.t_10, basis, match);
    ++sum.count;
  }
  return sum;
}

template <Scalar S>
[[nodiscard]] Status judge(const RelativePoseTally<S>& sum, const RelativePose<S>& pose, std::size_t matches,
                           const RelativePoseOptions<S>& options, RelativePoseSummary<S>& summary) noexcept {
  summary.inliers = static_cast<int>(sum.count);
  summary.mean_squared_error = sum.squared_error / std::max(sum.count, S(1));
  if (summary.inliers < options.min_inliers || sum.count < options.min_inlier_share * static_cast<S>(matches))
    return Status::kNoConsensus;
  if (sum.moved < options.min_moved_share * sum.count) return Status::kLowParallax;
  const S chance = 6 * std::sqrt(2 / sum.count);  // spread of what noise alone reaches
  Mat<S, 5, 5> information = sum.equations.H;
  information.template bottomRightCorner<2, 2>() -= (1 + chance) * sum.noise;
  if (Eigen::LLT<Mat<S, 5, 5>>(information).info() != Eigen::Success) return Status::kDegenerate;
  information.template bottomRightCorner<2, 2>() += chance * sum.noise;
  Mat<S, 5, 5> covariance;
  // Finite: the inverse of tiny numbers overflows.
  if (!inverse_of<S, 5>(information, covariance)) return Status::kDegenerate;
  const Mat<S, 3, 2> basis = tangent_basis(pose.t_10);
  summary.rotation_covariance = covariance.template topLeftCorner<3, 3>();
  summary.translation_covariance = basis * covariance.template bottomRightCorner<2, 2>() * basis.transpose();
  const S variance = summary.translation_covariance.trace();
  const S limit = options.max_direction_sigma * options.max_direction_sigma;
  return variance < limit ? Status::kOk : Status::kDegenerate;
}

}  // namespace detail

// Improves R_10 and t_10 over the epipolar errors; both, and `inliers` (empty, or one flag a match), are
// written on success alone. Mismatches are gated at the start and again after each round.
template <Scalar S>
[[nodiscard]] RelativePoseSummary<S> refine_relative_pose(std::span<const BearingMatch<S>> matches,
                                                          SO3<S>& R_10, Vec3<S>& t_10,
                                                          const RelativePoseOptions<S>& options,
                                                          std::span<std::uint8_t> inliers = {}) noexcept {
  RelativePoseSummary<S> summary;
  const auto refuse = [&](Status status) {
    summary.status = status;
    return summary;
  };
  const S length = t_10.norm();
  if (!std::isfinite(length) || !R_10.matrix().allFinite() || !all_finite(matches))
    return refuse(Status::kNotFinite);
  if (static_cast<int>(matches.size()) < std::max(options.min_inliers, 5)) return summary;
  if (!(length > 0)) return refuse(Status::kDegenerate);

  RelativePose<S> pose{R_10, t_10 / length};
  FlowGate<S> gate{.max_error = options.max_error};
  S sigma = options.start_sigma;
  ParallaxMedians<S> medians;
  for (int round = 0; round < 3; ++round) {
    const EpipolarProblem<S> problem(matches, options, pose, gate, sigma);
    const Status status = minimize(problem, pose, options.solver).status;
    if (status != Status::kOk && status != Status::kNotConverged)
      return refuse(status == Status::kTooFew ? Status::kNoConsensus : status);
    Random random(0);
    const FlowSample<S> sample(matches, pose.R_10.matrix(), S(0), options.min_parallax, random);
    gate.nearest = std::numeric_limits<S>::max();
    medians = parallax_medians(sample, gate, pose.t_10);
    gate.nearest = options.max_nearness * medians.nearness;
    sigma = 0;
  }
  const EpipolarProblem<S> problem(matches, options, pose, gate, S(0));
  summary.parallax = medians.angle;
  summary.status = detail::judge(detail::tally(matches, problem, pose, options.min_parallax), pose,
                                 matches.size(), options, summary);
  if (!usable(summary.status)) return summary;
  R_10 = pose.R_10;
  t_10 = pose.t_10;
  if (inliers.size() == matches.size())
    for (std::size_t i = 0; i < matches.size(); ++i) inliers[i] = problem.accepts(matches[i]);
  return summary;
}

}  // namespace sslam
