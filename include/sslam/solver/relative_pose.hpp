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
#include "sslam/geometry/so3.hpp"
#include "sslam/geometry/sphere.hpp"
#include "sslam/solver/epipolar.hpp"
#include "sslam/solver/flow_sample.hpp"
#include "sslam/solver/levenberg_marquardt.hpp"

namespace sslam {

// x1 ~ R x0 + t / depth0 with |t| = 1. Tangent: (phi, delta), phi a left perturbation of R, delta on
// tangent_basis(t).
template <Scalar S>
struct RelativePose {
  using ScalarType = S;
  static constexpr int kDof = 5;
  SO3<S> R_10;
  Vec3<S> t_10 = Vec3<S>::UnitX();

  [[nodiscard]] RelativePose retract(const Vec<S, 5>& delta) const noexcept {
    return {R_10.retract(delta.template head<3>()),
            (t_10 + tangent_basis(t_10) * delta.template tail<2>()).normalized()};
  }
};

template <Scalar S>
struct RelativePoseOptions {
  S max_error = 3;             // largest epipolar error of an inlier, standard deviations
  S start_sigma = S(0.005);    // how far from the truth the rotation may start, rad: opens the first gate
  S max_nearness = 6;          // an inlier this many times nearer than the median of the moved is a mismatch
  S min_parallax = 3;          // a match has moved when its flow is longer than this, standard deviations
  S min_moved_share = S(0.3);  // of the inliers; with fewer, nothing tells the translation: kLowParallax
  S max_direction_sigma = S(0.35);  // of t_10, rad: beyond, kDegenerate
  S min_inlier_share = S(0.3);      // of all matches: else kNoConsensus
  int min_inliers = 12;
  SO3<S> prior_R_10;  // a rotation known from elsewhere (Manhattan axes), and
  Mat3<S> prior_information =
      Mat3<S>::Zero();  // its inverse covariance (left perturbation, rad^-2); zero: none
  LmOptions solver;
};

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

// Cost of a relative pose over the matches that a gate at a fixed pose lets through: which matches count does
// not change within one minimisation, and no list of them is needed.
template <Scalar S>
class EpipolarProblem {
 public:
  EpipolarProblem(std::span<const BearingMatch<S>> matches, const RelativePoseOptions<S>& options,
                  const RelativePose<S>& gate_pose, const FlowGate<S>& gate, S rotation_sigma) noexcept
      : matches_(matches),
        options_(options),
        gate_R_(gate_pose.R_10.matrix()),
        gate_t_(gate_pose.t_10),
        gate_(gate),
        rotation_sigma_(rotation_sigma) {}

  [[nodiscard]] bool accepts(const BearingMatch<S>& match) const noexcept {
    Flow<S> flow;
    return compensate(gate_R_, match, rotation_sigma_, flow) && gate_.accepts(flow, gate_t_);
  }

  [[nodiscard]] Evaluated<S> operator()(const RelativePose<S>& pose,
                                        NormalEquations<S, 5>* equations) const noexcept {
    const Mat3<S> R = pose.R_10.matrix();
    const Mat<S, 3, 2> basis = tangent_basis(pose.t_10);
    Evaluated<S> sum;
    for (const BearingMatch<S>& match : matches_) {
      if (!accepts(match)) continue;
      ++sum.count;
      if (!equations) {
        const S r = epipolar_residual(R, pose.t_10, match);
        sum.cost += loss(r * r);
        continue;
      }
      const EpipolarRow<S> row = epipolar_row(R, pose.t_10, match);
      Mat<S, 1, 5> j;
      j << row.wrt_rotation.transpose(), row.wrt_translation.transpose() * basis;
      const S squared = row.residual * row.residual;
      equations->add(j, row.residual, weight(squared));
      sum.cost += loss(squared);
    }
    sum.cost += prior(pose, equations);
    return sum;
  }

  // Cauchy: bounded influence, smooth, and it still pulls from afar.
  static constexpr S kScale = 4;  // squared width, variances
  [[nodiscard]] static S loss(S squared) noexcept { return kScale * std::log1p(squared / kScale); }
  [[nodiscard]] static S weight(S squared) noexcept { return kScale / (kScale + squared); }

 private:
  [[nodiscard]] S prior(const RelativePose<S>& pose, NormalEquations<S, 5>* equations) const noexcept {
    if (options_.prior_information.isZero(S(0))) return 0;
    const Vec3<S> phi = (pose.R_10 * options_.prior_R_10.inverse()).log();
    const Vec3<S> pull = options_.prior_information * phi;
    if (equations) {  // to first order in phi, which the prior keeps small
      equations->H.template topLeftCorner<3, 3>() += options_.prior_information;
      equations->g.template head<3>() += pull;
    }
    return phi.dot(pull);
  }

  std::span<const BearingMatch<S>> matches_;
  const RelativePoseOptions<S>& options_;
  Mat3<S> gate_R_;
  Vec3<S> gate_t_;
  FlowGate<S> gate_;
  S rotation_sigma_;
};

// What the noise of the observations adds to the translation block of J^T J for one match (see
// EpipolarRow::slope).
template <Scalar S>
[[nodiscard]] Mat2<S> epipolar_row_noise(const Mat3<S>& R_10, const Vec3<S>& t_10, const Mat<S, 3, 2>& basis,
                                         const BearingMatch<S>& match) noexcept {
  const Vec3<S> x0 = R_10 * match.ray0;
  const Vec3<S> axis0 = R_10.col(2);
  const auto seen = [&](const Vec3<S>& t) {  // derivative of the four derivatives of e, along t
    const Vec3<S> plane0 = match.ray1.cross(t);
    const Vec3<S> plane1 = t.cross(x0);
    Vec<S, 5> out;
    out << plane0 - axis0 * axis0.dot(plane0), plane1.template head<2>();
    return out;
  };
  const Vec<S, 5> along_t = seen(t_10);
  Mat<S, 5, 2> across;
  across << seen(basis.col(0)), seen(basis.col(1));
  const S d = along_t.squaredNorm() + match.sigma * match.sigma;
  const Vec2<S> slope = across.transpose() * along_t / d;
  return across.transpose() * across / d - slope * slope.transpose();
}

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
  (void)problem(pose, &sum.equations);
  sum.equations.complete();
  Flow<S> flow;
  for (const BearingMatch<S>& match : matches) {
    if (!problem.accepts(match) || !compensate(R, match, S(0), flow)) continue;
    const S r = epipolar_residual(R, pose.t_10, match);
    sum.squared_error += r * r;
    if (flow.weight * flow.squared_length() > min_parallax * min_parallax) ++sum.moved;
    sum.noise += EpipolarProblem<S>::weight(r * r) * epipolar_row_noise(R, pose.t_10, basis, match);
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
  const Eigen::LLT<Mat<S, 5, 5>> factor(information);
  if (factor.info() != Eigen::Success) return Status::kDegenerate;
  const Mat<S, 5, 5> covariance = factor.solve(Mat<S, 5, 5>::Identity());
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
  if (!std::isfinite(length) || !R_10.matrix().allFinite() ||
      !std::all_of(matches.begin(), matches.end(), is_finite<S>))
    return refuse(Status::kNotFinite);
  if (static_cast<int>(matches.size()) < std::max(options.min_inliers, 5)) return summary;
  if (!(length > 0)) return refuse(Status::kDegenerate);

  RelativePose<S> pose{R_10, t_10 / length};
  FlowGate<S> gate{.max_error = options.max_error};
  S sigma = options.start_sigma;
  ParallaxMedians<S> medians;
  for (int round = 0; round < 3; ++round) {
    const detail::EpipolarProblem<S> problem(matches, options, pose, gate, sigma);
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
  const detail::EpipolarProblem<S> problem(matches, options, pose, gate, S(0));
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
