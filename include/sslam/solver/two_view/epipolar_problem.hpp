// SPDX-License-Identifier: BSD-3-Clause
// The least-squares problem of a relative pose over epipolar errors, gated and robust, with an optional prior
// on the rotation.
#pragma once

#include <cmath>
#include <span>

#include "sslam/core/parameter.hpp"
#include "sslam/geometry/so3.hpp"
#include "sslam/geometry/sphere.hpp"
#include "sslam/residual/loss.hpp"
#include "sslam/solver/least_squares/levenberg_marquardt.hpp"
#include "sslam/solver/two_view/epipolar.hpp"
#include "sslam/solver/two_view/flow_sample.hpp"

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

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_error", self.max_error, Unit::kNumber, 0.1, 100,
          "largest epipolar error of an inlier, standard deviations");
    visit("start_sigma", self.start_sigma, Unit::kDegrees, 0, 180,
          "how far from the truth the rotation may start");
    visit("max_nearness", self.max_nearness, Unit::kNumber, 1, kUnbounded,
          "an inlier so many times nearer than the median of the moved is a mismatch");
    visit("min_parallax", self.min_parallax, Unit::kNumber, 0, 100,
          "flow of a match that has moved, standard deviations");
    visit("min_moved_share", self.min_moved_share, Unit::kShare, 0, 1,
          "of the inliers; with fewer, nothing tells the translation");
    visit("max_direction_sigma", self.max_direction_sigma, Unit::kDegrees, 0, 180,
          "standard deviation of the direction of the translation");
    visit("min_inlier_share", self.min_inlier_share, Unit::kShare, 0, 1, "of all matches");
    visit("min_inliers", self.min_inliers, Unit::kCount, 5, 1e6, "matches that agree with the pose");
    visit_within("solver.", self.solver, visit);
  }
};
static_assert(Described<RelativePoseOptions<double>>);

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
                                        NormalEquations<S, 5>& equations) const noexcept {
    const Mat3<S> R = pose.R_10.matrix();
    const Mat<S, 3, 2> basis = tangent_basis(pose.t_10);
    Evaluated<S> sum;
    for (const BearingMatch<S>& match : matches_) {
      if (!accepts(match)) continue;
      ++sum.count;
      const EpipolarRow<S> row = epipolar_row(R, pose.t_10, match);
      Mat<S, 1, 5> j;
      j << row.wrt_rotation.transpose(), row.wrt_translation.transpose() * basis;
      const S squared = row.residual * row.residual;
      equations.add(j, row.residual, kLoss.weight(squared));
      sum.cost += kLoss.rho(squared);
    }
    sum.cost += prior(pose, equations);
    return sum;
  }

  // Cauchy: bounded influence, smooth, and it still pulls from afar.
  static constexpr CauchyLoss<S> kLoss{.width = 2};  // standard deviations

 private:
  [[nodiscard]] S prior(const RelativePose<S>& pose, NormalEquations<S, 5>& equations) const noexcept {
    if (options_.prior_information.isZero(S(0))) return 0;
    const Vec3<S> phi = (pose.R_10 * options_.prior_R_10.inverse()).log();
    const Vec3<S> pull = options_.prior_information * phi;
    // To first order in phi, which the prior keeps small.
    equations.H.template topLeftCorner<3, 3>() += options_.prior_information;
    equations.g.template head<3>() += pull;
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

}  // namespace sslam
