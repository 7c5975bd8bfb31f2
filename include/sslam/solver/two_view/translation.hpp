// SPDX-License-Identifier: BSD-3-Clause
// Translation between two views whose relative rotation is known: the null vector of a linear system over the
// matches, robust to mismatches, with its sign, its uncertainty, and a refusal where the views do not show
// it.
#pragma once

#include <cstdint>
#include <span>

#include "sslam/core/parameter.hpp"
#include "sslam/core/status.hpp"
#include "sslam/geometry/so3.hpp"
#include "sslam/geometry/sphere.hpp"
#include "sslam/solver/two_view/direction_equations.hpp"
#include "sslam/solver/two_view/translation_search.hpp"

namespace sslam {

template <Scalar S>
struct TranslationOptions {
  S max_error = 3;       // largest distance of an inlier from its epipolar half-line, standard deviations
  S rotation_sigma = 0;  // uncertainty of R_10 about each axis, rad: widens the noise of every match
  S min_parallax = 3;    // a match has moved when its flow is longer than this, standard deviations
  S min_moved_share = S(0.2);  // of the inliers; with fewer it is a pure rotation: kLowParallax
  S max_nearness = 6;          // an inlier this many times nearer than the median of the moved is a mismatch
  S min_rival_error = S(1.6);  // mean squared error of the second best direction, variances: else kDegenerate
  S min_front_share = S(0.75);  // of the moved matches along their epipolar line, in front: else kBehind
  S min_inlier_share = S(0.3);  // of all matches: else kNoConsensus
  int min_inliers = 10;
  int max_samples = 200;    // pairs of matches tried at most
  S confidence = S(0.999);  // that one of the pairs is free of mismatches

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_error", self.max_error, Unit::kNumber, 0.1, 100,
          "largest distance of an inlier from its epipolar line, standard deviations");
    visit("max_nearness", self.max_nearness, Unit::kNumber, 1, kUnbounded,
          "an inlier so many times nearer than the median of the moved is a mismatch");
    visit("min_parallax", self.min_parallax, Unit::kNumber, 0, 100,
          "flow of a match that has moved, standard deviations");
    visit("min_moved_share", self.min_moved_share, Unit::kShare, 0, 1,
          "of the inliers; with fewer it is a pure rotation");
    visit("min_rival_error", self.min_rival_error, Unit::kNumber, 0, 100,
          "mean squared error of the second best direction, variances");
    visit("min_front_share", self.min_front_share, Unit::kShare, 0, 1,
          "of the moved matches that lie in front");
    visit("min_inlier_share", self.min_inlier_share, Unit::kShare, 0, 1, "of all matches");
    visit("min_inliers", self.min_inliers, Unit::kCount, 2, 1e6, "matches that agree with the translation");
    visit("max_samples", self.max_samples, Unit::kCount, 1, 1e6, "pairs of matches tried at most");
    visit("confidence", self.confidence, Unit::kShare, 0, 1, "that one of them is free of mismatches");
  }
};
static_assert(Described<TranslationOptions<double>>);

template <Scalar S>
struct TranslationEstimate {
  Status status = Status::kTooFew;
  Vec3<S> t_10 = Vec3<S>::Zero();         // unit; x1 ~ R_10 x0 + t_10 / depth0
  Mat3<S> covariance = Mat3<S>::Zero();   // of t_10, of rank 2, rad^2
  Vec3<S> eigenvalues = Vec3<S>::Zero();  // of the linear system, ascending; 1 is what noise gives
  S rival_error = 0;  // of the second best direction, mean of the truncated squares, variances
  S parallax = 0;     // median over the inliers, rad
  S front_share = 0;  // of the moved matches along their epipolar line
  int inliers = 0;
};

namespace detail {

template <Scalar S>
struct TranslationTally {
  FlowSystem<S> system;
  DirectionEquations<S> equations;
  S front = 0, behind = 0, moved = 0;
  Mat<S, 3, 2> basis;
};

template <Scalar S>
[[nodiscard]] TranslationTally<S> tally(std::span<const BearingMatch<S>> matches, const Mat3<S>& R_10,
                                        const Vec3<S>& t_10, const TranslationOptions<S>& options,
                                        const FlowGate<S>& gate) noexcept {
  TranslationTally<S> sum;
  sum.basis = tangent_basis(t_10);
  Flow<S> flow;
  for (const BearingMatch<S>& match : matches) {
    if (!compensate(R_10, match, options.rotation_sigma, flow)) continue;
    const EpipolarFit<S> fit = epipolar_fit(flow, t_10);
    const bool moved = flow.weight * flow.squared_length() > options.min_parallax * options.min_parallax;
    if (std::abs(fit.across) < gate.max_error && fit.along < -options.min_parallax) ++sum.behind;
    if (!gate.accepts(fit)) continue;
    if (fit.along > options.min_parallax) ++sum.front;
    if (moved) ++sum.moved;
    sum.system.add(flow);
    sum.equations.add(flow, t_10, sum.basis);
  }
  return sum;
}

// Mean of the truncated squared errors of a direction over those flows that the gate accepts at t_10.
template <Scalar S>
[[nodiscard]] S rival_error(const FlowSample<S>& sample, const FlowGate<S>& gate, const Vec3<S>& t_10,
                            const Vec3<S>& rival) noexcept {
  S sum = 0, count = 0;
  for (const Flow<S>& flow : sample.view()) {
    if (!gate.accepts(flow, t_10)) continue;
    const S across = epipolar_fit(flow, rival).across;
    sum += std::min(across * across, gate.max_error * gate.max_error);
    ++count;
  }
  return count > 0 ? sum / count : S(0);
}

template <Scalar S>
[[nodiscard]] Status judge(const TranslationTally<S>& sum, const FlowSample<S>& sample,
                           const FlowGate<S>& gate, std::size_t matches, const TranslationOptions<S>& options,
                           TranslationEstimate<S>& estimate) noexcept {
  const auto count = static_cast<S>(sum.system.count);
  estimate.inliers = sum.system.count;
  estimate.front_share = sum.front / std::max(sum.front + sum.behind, S(1));
  if (estimate.inliers < options.min_inliers || count < options.min_inlier_share * static_cast<S>(matches))
    return Status::kNoConsensus;
  if (sum.moved < options.min_moved_share * count) return Status::kLowParallax;
  FlowSolution<S> solution;
  if (!sum.system.solve(solution)) return Status::kDegenerate;
  estimate.eigenvalues = solution.eigenvalues;
  estimate.rival_error = rival_error(sample, gate, estimate.t_10, solution.rival);
  // Mismatches that agree with the best direction by chance seldom agree with its rival too.
  constexpr S kAgreeByChance = S(0.07);
  const S mismatches = static_cast<S>(matches) / count - 1;
  const S by_chance = kAgreeByChance * mismatches * options.max_error * options.max_error;
  if (estimate.rival_error < options.min_rival_error + by_chance) return Status::kDegenerate;
  const S chance = 6 * std::sqrt(2 / count);
  if (!sum.equations.covariance(sum.basis, chance, estimate.covariance)) return Status::kDegenerate;
  return estimate.front_share < options.min_front_share ? Status::kBehind : Status::kOk;
}

}  // namespace detail

// t_10 from matches and R_10; `inliers` (empty, or one flag a match) is written on success alone. The same
// seed gives the same answer. Half of the matches may be wrong, as long as the wrong ones do not agree with
// each other.
//   (R_10 x0 x x1) . t_10 = 0      (Li et al., RA-L 2020, section IV; Kneip, Chli and Siegwart, BMVC 2011)
template <Scalar S>
[[nodiscard]] TranslationEstimate<S> translation_from_rotation(
    std::span<const BearingMatch<S>> matches, const SO3<S>& R_10, const TranslationOptions<S>& options,
    std::uint64_t seed, std::span<std::uint8_t> inliers = {}) noexcept {
  TranslationEstimate<S> estimate;
  const auto refuse = [&](Status status) {
    estimate.status = status;
    return estimate;
  };
  const Mat3<S> R = R_10.matrix();
  if (!R.allFinite() || !all_finite(matches)) return refuse(Status::kNotFinite);
  if (static_cast<int>(matches.size()) < std::max(options.min_inliers, 2)) return estimate;

  Random random(seed);
  const FlowSample<S> sample(matches, R, options.rotation_sigma, options.min_parallax, random);
  TranslationSearch<S> search{{.max_error = options.max_error}, options.max_samples, options.confidence};
  const S least_moved = options.min_moved_share * options.min_inlier_share * static_cast<S>(sample.size);
  if (sample.moved_count < 2 || static_cast<S>(sample.moved_count) < least_moved)
    return refuse(Status::kLowParallax);
  Vec3<S> t;
  if (!search.run(sample, random, t)) return refuse(Status::kDegenerate);

  FlowGate<S> gate = search.gate;
  gate.nearest = options.max_nearness * parallax_medians(sample, gate, t).nearness;
  detail::TranslationTally<S> sum = detail::tally(matches, R, t, options, gate);
  for (int iteration = 0; iteration < 3 && sum.equations.step(sum.basis, t); ++iteration)
    sum = detail::tally(matches, R, t, options, gate);
  estimate.t_10 = t;
  estimate.parallax = parallax_medians(sample, gate, t).angle;
  estimate.status = detail::judge(sum, sample, gate, matches.size(), options, estimate);
  if (!usable(estimate.status) || inliers.size() != matches.size()) return estimate;
  Flow<S> flow;
  for (std::size_t i = 0; i < matches.size(); ++i)
    inliers[i] = compensate(R, matches[i], options.rotation_sigma, flow) && gate.accepts(flow, t);
  return estimate;
}

}  // namespace sslam
