// SPDX-License-Identifier: BSD-3-Clause
// Camera pose from matched points and lines of the map: six degrees of freedom, three with a known rotation.
#pragma once

#include <algorithm>

#include "sslam/core/parameter.hpp"
#include "sslam/solver/pose/pose_problem.hpp"

namespace sslam {

template <Scalar S>
struct PoseRefinementOptions {
  int rounds = 3;            // of solving and sorting out mismatches
  S huber = S(2);            // standard deviations beyond which an error pulls less
  S gate = S(5.991);         // chi-square of two degrees of freedom at 95 %: beyond it a match is an outlier
  S prior_huber = S(2);      // the same for the rotation prior, so that a wrong one lets go
  int min_observations = 3;  // points plus lines
  LmOptions solver;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("rounds", self.rounds, Unit::kCount, 1, 100, "of solving and sorting out mismatches");
    visit("huber", self.huber, Unit::kNumber, 0.01, 100,
          "standard deviations beyond which an error pulls less");
    visit("gate", self.gate, Unit::kNumber, 0.01, 1000, "chi-square beyond which a match is an outlier");
    visit("prior_huber", self.prior_huber, Unit::kNumber, 0.01, 100,
          "standard deviations beyond which the rotation prior pulls less");
    visit("min_observations", self.min_observations, Unit::kCount, 3, 1000, "points plus lines");
    visit_within("solver.", self.solver, visit);
  }
};
static_assert(Described<PoseRefinementOptions<double>>);

template <Scalar S, int D>
struct PoseSummary {
  Status status = Status::kTooFew;
  int iterations = 0;
  int point_inliers = 0, line_inliers = 0;
  S cost = 0;
  // J^T W J of the inliers (and the prior), tangent (phi, rho) or rho.
  Mat<S, D, D> information = Mat<S, D, D>::Zero();
};

namespace detail {

template <Scalar S, class X>
[[nodiscard]] PoseSummary<S, X::kDof> refine(const Pinhole<S>& pinhole,
                                             std::span<const PointObservation<S>> points,
                                             std::span<const LineObservation<S>> lines, X& state,
                                             const PoseRefinementOptions<S>& options,
                                             std::span<std::uint8_t> point_inliers,
                                             std::span<std::uint8_t> line_inliers,
                                             const RotationPrior<S>* prior) noexcept {
  PoseSummary<S, X::kDof> summary;
  const auto observations = static_cast<int>(points.size() + lines.size());
  if (observations < options.min_observations) return summary;
  if (!all_finite(points, lines, pose_of(state))) {
    summary.status = Status::kNotFinite;
    return summary;
  }
  std::fill(point_inliers.begin(), point_inliers.end(), std::uint8_t{1});
  std::fill(line_inliers.begin(), line_inliers.end(), std::uint8_t{1});
  X x = state;
  for (int round = 0; round < options.rounds; ++round) {
    const PoseProblem<S> problem{pinhole,
                                 points,
                                 lines,
                                 point_inliers,
                                 line_inliers,
                                 prior,
                                 HuberLoss<S>{options.huber},
                                 HuberLoss<S>{options.prior_huber}};
    const auto solved = minimize(problem, x, options.solver);
    summary.iterations += solved.iterations;
    summary.cost = solved.final_cost;
    summary.information = solved.information;
    summary.status = solved.status;
    if (solved.status != Status::kOk && solved.status != Status::kNotConverged) return summary;
    const int inliers =
        classify(pinhole, points, lines, pose_of(x), options.gate, point_inliers, line_inliers);
    if (inliers < options.min_observations) {
      summary.status = Status::kNoConsensus;
      return summary;
    }
  }
  if (!is_observable(summary.information)) {
    summary.status = Status::kDegenerate;
    return summary;
  }
  summary.status = Status::kOk;
  for (const auto in : point_inliers) summary.point_inliers += in;
  for (const auto in : line_inliers) summary.line_inliers += in;
  state = x;
  return summary;
}

}  // namespace detail

// Full pose. The flags (one an observation) are written with what was an inlier in the end; the pose changes
// only on success. Robust by rounds: Huber over all, then over what passes the chi-square gate, which each
// round tests anew. kTooFew; kNotFinite; kNoConsensus: fewer than min_observations agree; kDegenerate: they
// leave a motion undetermined.
template <Scalar S>
[[nodiscard]] PoseSummary<S, 6> refine_pose(const Pinhole<S>& pinhole,
                                            std::span<const PointObservation<S>> points,
                                            std::span<const LineObservation<S>> lines, SE3<S>& cam_from_world,
                                            const PoseRefinementOptions<S>& options,
                                            std::span<std::uint8_t> point_inliers,
                                            std::span<std::uint8_t> line_inliers,
                                            const RotationPrior<S>* prior = nullptr) noexcept {
  return detail::refine(pinhole, points, lines, cam_from_world, options, point_inliers, line_inliers, prior);
}

// Translation alone, with the rotation of cam_from_world as given: the right half of the Jacobians.
template <Scalar S>
[[nodiscard]] PoseSummary<S, 3> refine_translation(const Pinhole<S>& pinhole,
                                                   std::span<const PointObservation<S>> points,
                                                   std::span<const LineObservation<S>> lines,
                                                   SE3<S>& cam_from_world,
                                                   const PoseRefinementOptions<S>& options,
                                                   std::span<std::uint8_t> point_inliers,
                                                   std::span<std::uint8_t> line_inliers) noexcept {
  detail::TranslationState<S> state{cam_from_world};
  const auto summary = detail::refine<S>(pinhole, points, lines, state, options, point_inliers, line_inliers,
                                         static_cast<const RotationPrior<S>*>(nullptr));
  if (usable(summary.status)) cam_from_world = state.pose;
  return summary;
}

}  // namespace sslam
