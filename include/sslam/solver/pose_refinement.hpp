// SPDX-License-Identifier: BSD-3-Clause
// Camera pose from matched points and lines of the map: six degrees of freedom, or three with the rotation known.
#pragma once

#include <cstdint>
#include <span>

#include "sslam/residual/line_reprojection.hpp"
#include "sslam/residual/loss.hpp"
#include "sslam/residual/point_reprojection.hpp"
#include "sslam/solver/levenberg_marquardt.hpp"

namespace sslam {

template <Scalar S>
struct PointObservation {
  Vec3<S> point_world;
  Vec2<S> pixel;  // undistorted
  S sigma = 1;    // of each coordinate, pixels
};

template <Scalar S>
struct LineObservation {
  Line3<S> line_world;
  Segment2<S> segment;  // undistorted, pixels
  S sigma = 1;          // of an end across the segment, pixels
};

// What structure says about the rotation: a mean and the information of its left perturbation (camera frame, rad^-2).
template <Scalar S>
struct RotationPrior {
  SO3<S> cam_from_world;
  Mat3<S> information;
};

template <Scalar S>
struct PoseRefinementOptions {
  int rounds = 3;           // of solving and sorting out mismatches
  S huber = S(2);           // standard deviations beyond which an error pulls less
  S gate = S(5.991);        // chi-square of two degrees of freedom at 95 %: beyond it a match is an outlier
  S prior_huber = S(2);     // the same for the rotation prior, so that a wrong one lets go
  int min_observations = 3; // points plus lines
  LmOptions solver;
};

template <Scalar S, int D>
struct PoseSummary {
  Status status = Status::kTooFew;
  int iterations = 0;
  int point_inliers = 0, line_inliers = 0;
  S cost = 0;
  Mat<S, D, D> information = Mat<S, D, D>::Zero();  // of the inliers (and the prior), tangent (phi, rho) or rho
};

namespace detail {

// The pose as a state with three degrees of freedom.
template <Scalar S>
struct TranslationState {
  using ScalarType = S;
  static constexpr int kDof = 3;
  SE3<S> pose;
  [[nodiscard]] TranslationState retract(const Vec3<S>& rho) const noexcept {
    return {{pose.rotation, pose.translation + rho}};
  }
};

template <Scalar S>
[[nodiscard]] const SE3<S>& pose_of(const SE3<S>& pose) noexcept { return pose; }
template <Scalar S>
[[nodiscard]] const SE3<S>& pose_of(const TranslationState<S>& state) noexcept { return state.pose; }

template <Scalar S>
struct PoseProblem {
  const Pinhole<S>& pinhole;
  std::span<const PointObservation<S>> points;
  std::span<const LineObservation<S>> lines;
  std::span<const std::uint8_t> point_inliers, line_inliers;
  const RotationPrior<S>* prior;
  HuberLoss<S> loss;
  HuberLoss<S> prior_loss;

  template <class X>
  Evaluated<S> operator()(const X& x, NormalEquations<S, X::kDof>* equations) const noexcept {
    constexpr int D = X::kDof;
    const SE3<S>& pose = pose_of(x);
    Evaluated<S> sum;
    PointReprojection<S> point;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!point_inliers[i] || !point_reprojection(pinhole, pose, points[i].point_world, points[i].pixel, point)) continue;
      const S inverse = 1 / (points[i].sigma * points[i].sigma);
      add<D>(point.error, inverse, sum, equations, [&] {
        if constexpr (D == 6) return point.wrt_pose();
        else return point.wrt_translation();
      });
    }
    LineReprojection<S> line;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (!line_inliers[i] || !line_reprojection(pinhole, pose, lines[i].line_world, lines[i].segment, line)) continue;
      const S inverse = 1 / (lines[i].sigma * lines[i].sigma);
      add<D>(line.error, inverse, sum, equations, [&] {
        if constexpr (D == 6) return line.wrt_pose();
        else return line.wrt_translation();
      });
    }
    if constexpr (D == 6)
      if (prior != nullptr) add_prior(pose, sum, equations);
    return sum;
  }

 private:
  template <int D, class Jacobian>
  void add(const Vec2<S>& error, S inverse_variance, Evaluated<S>& sum, NormalEquations<S, D>* equations,
           Jacobian jacobian) const noexcept {
    const S squared = error.squaredNorm() * inverse_variance;
    sum.cost += loss.rho(squared);
    ++sum.count;
    if (equations == nullptr) return;
    const S w = inverse_variance * loss.weight(squared);
    const Mat<S, 2, D> j = jacobian();
    equations->add(j.row(0), error[0], w);
    equations->add(j.row(1), error[1], w);
  }

  // e = Log(R R_prior^-1); d e / d phi is taken as the identity, which holds near the prior.
  void add_prior(const SE3<S>& pose, Evaluated<S>& sum, NormalEquations<S, 6>* equations) const noexcept {
    const Vec3<S> e = (pose.rotation * prior->cam_from_world.inverse()).log();
    const Vec3<S> weighted = prior->information * e;
    const S squared = e.dot(weighted);
    sum.cost += prior_loss.rho(squared);
    if (equations == nullptr) return;
    const S w = prior_loss.weight(squared);
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b <= a; ++b) equations->H(a, b) += w * prior->information(a, b);
      equations->g[a] += w * weighted[a];
    }
  }
};

// Marks what agrees with the pose within the gate; returns the number that does.
template <Scalar S>
int classify(const Pinhole<S>& pinhole, std::span<const PointObservation<S>> points,
             std::span<const LineObservation<S>> lines, const SE3<S>& pose, S gate,
             std::span<std::uint8_t> point_inliers, std::span<std::uint8_t> line_inliers) noexcept {
  int inliers = 0;
  PointReprojection<S> point;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool in = point_reprojection(pinhole, pose, points[i].point_world, points[i].pixel, point) &&
                    point.error.squaredNorm() <= gate * points[i].sigma * points[i].sigma;
    point_inliers[i] = in;
    inliers += in;
  }
  LineReprojection<S> line;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const bool in = line_reprojection(pinhole, pose, lines[i].line_world, lines[i].segment, line) &&
                    line.error.squaredNorm() <= gate * lines[i].sigma * lines[i].sigma;
    line_inliers[i] = in;
    inliers += in;
  }
  return inliers;
}

template <Scalar S, class X>
[[nodiscard]] PoseSummary<S, X::kDof> refine(const Pinhole<S>& pinhole, std::span<const PointObservation<S>> points,
                                             std::span<const LineObservation<S>> lines, X& state,
                                             const PoseRefinementOptions<S>& options,
                                             std::span<std::uint8_t> point_inliers,
                                             std::span<std::uint8_t> line_inliers,
                                             const RotationPrior<S>* prior) noexcept {
  PoseSummary<S, X::kDof> summary;
  const auto observations = static_cast<int>(points.size() + lines.size());
  if (observations < options.min_observations) return summary;
  std::fill(point_inliers.begin(), point_inliers.end(), std::uint8_t{1});
  std::fill(line_inliers.begin(), line_inliers.end(), std::uint8_t{1});
  X x = state;
  for (int round = 0; round < options.rounds; ++round) {
    const PoseProblem<S> problem{pinhole, points, lines, point_inliers, line_inliers, prior,
                                 HuberLoss<S>{options.huber}, HuberLoss<S>{options.prior_huber}};
    const auto solved = minimize(problem, x, options.solver);
    summary.iterations += solved.iterations;
    summary.cost = solved.final_cost;
    summary.information = solved.information;
    summary.status = solved.status;
    if (solved.status != Status::kOk && solved.status != Status::kNotConverged) return summary;
    const int inliers = classify(pinhole, points, lines, pose_of(x), options.gate, point_inliers, line_inliers);
    if (inliers < options.min_observations) {
      summary.status = Status::kNoConsensus;
      return summary;
    }
  }
  summary.status = Status::kOk;
  for (const auto in : point_inliers) summary.point_inliers += in;
  for (const auto in : line_inliers) summary.line_inliers += in;
  state = x;
  return summary;
}

}  // namespace detail

// Full pose. The flags (one an observation) are written with what was an inlier in the end; the pose changes only on
// success. Robust by rounds: Huber over all, then over what passes the chi-square gate, which each round tests anew.
template <Scalar S>
[[nodiscard]] PoseSummary<S, 6> refine_pose(const Pinhole<S>& pinhole, std::span<const PointObservation<S>> points,
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
                                                   std::span<const LineObservation<S>> lines, SE3<S>& cam_from_world,
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
