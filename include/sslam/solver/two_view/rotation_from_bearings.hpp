// SPDX-License-Identifier: BSD-3-Clause
// The rotation alone that carries the bearings of one view over to another (Wahba's problem, robust): how
// many matches it explains tells a pure rotation from a translation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "sslam/core/parameter.hpp"
#include "sslam/core/status.hpp"
#include "sslam/solver/least_squares/positive_inverse.hpp"
#include "sslam/solver/two_view/bearing_pair.hpp"
#include "sslam/solver/two_view/stratified_sample.hpp"

namespace sslam {

template <Scalar S>
struct RotationFromBearingsOptions {
  S max_error = 3;              // largest angle between R_10 x0 and x1 of an inlier, standard deviations
  S max_sigma = S(0.02);        // of the rotation about any axis, rad: else kDegenerate
  S min_inlier_share = S(0.3);  // of all matches: else kNoConsensus
  int min_inliers = 10;
  int max_samples = 100;    // pairs of matches tried at most
  S confidence = S(0.999);  // that one of the pairs is free of mismatches

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_error", self.max_error, Unit::kNumber, 0.1, 100,
          "largest error of an inlier, standard deviations");
    visit("max_sigma", self.max_sigma, Unit::kDegrees, 0, 180,
          "standard deviation of the rotation about any axis");
    visit("min_inlier_share", self.min_inlier_share, Unit::kShare, 0, 1, "of all matches");
    visit("min_inliers", self.min_inliers, Unit::kCount, 2, 1e6, "matches that agree with the rotation");
    visit("max_samples", self.max_samples, Unit::kCount, 1, 1e6, "pairs of matches tried at most");
    visit("confidence", self.confidence, Unit::kShare, 0, 1, "that one of them is free of mismatches");
  }
};
static_assert(Described<RotationFromBearingsOptions<double>>);

template <Scalar S>
struct RotationFromBearings {
  Status status = Status::kTooFew;
  SO3<S> R_10;                           // the best found, unless kTooFew or kNotFinite
  Mat3<S> covariance = Mat3<S>::Zero();  // of its left perturbation, rad^2
  int inliers = 0;
};

namespace detail {

template <Scalar S>
class RotationSearch {
 public:
  static constexpr std::size_t kCapacity = 256;

  RotationSearch(std::span<const BearingMatch<S>> matches, const RotationFromBearingsOptions<S>& options,
                 Random& random) noexcept
      : options_(options), size_(std::min(matches.size(), kCapacity)) {
    for (std::size_t slot = 0; slot < size_; ++slot) {
      pairs_[slot] = BearingPair<S>(matches[stratified_index(slot, size_, matches.size(), random)]);
    }
  }

  // The best of identity and the rotations of random pairs, each new best improved over its inliers.
  [[nodiscard]] SO3<S> run(Random& random) const noexcept {
    SO3<S> best;
    S score = improve(best, std::numeric_limits<S>::max());
    int budget = samples_needed(best);
    for (int k = 0; k < budget; ++k) {
      SO3<S> R;
      if (!rotation_from_two(draw(random), draw(random), options_.max_error, R)) continue;
      const S trial = improve(R, score);
      if (!(trial < score)) continue;
      score = trial;
      best = R;
      budget = std::min(budget, samples_needed(best));
    }
    return best;
  }

 private:
  [[nodiscard]] const BearingPair<S>& draw(Random& random) const noexcept {
    return pairs_[random.below(static_cast<std::uint32_t>(size_))];
  }

  // Truncated squared error, summed; stops above `limit`.
  [[nodiscard]] S cost(const Mat3<S>& R, S limit) const noexcept {
    S sum = 0;
    for (std::size_t i = 0; i < size_ && sum < limit; ++i)
      sum += std::min(pairs_[i].squared_error(R), options_.max_error * options_.max_error);
    return sum;
  }

  // Returns the cost of R after improvement; R stays as it is when it does not come below `limit` at once.
  [[nodiscard]] S improve(SO3<S>& R, S limit) const noexcept {
    S score = cost(R.matrix(), limit);
    if (!(score < limit)) return score;
    for (int round = 0; round < 3; ++round) {
      const Mat3<S> matrix = R.matrix();
      BearingEquations<S> equations;
      const S wide = 4 * options_.max_error * options_.max_error;
      for (std::size_t i = 0; i < size_; ++i) equations.add(pairs_[i], matrix, wide);
      SO3<S> better = R;
      if (!equations.step(better)) break;
      const S trial = cost(better.matrix(), score);
      if (!(trial < score)) break;
      score = trial;
      R = better;
    }
    return score;
  }

  [[nodiscard]] int samples_needed(const SO3<S>& R) const noexcept {
    const Mat3<S> matrix = R.matrix();
    int good = 0;
    for (std::size_t i = 0; i < size_; ++i)
      good += pairs_[i].squared_error(matrix) < options_.max_error * options_.max_error;
    const S share = static_cast<S>(good) / static_cast<S>(size_);
    const S needed = std::log1p(-options_.confidence) / std::log1p(-std::min(share * share, S(0.99)));
    return needed < static_cast<S>(options_.max_samples) ? static_cast<int>(needed) + 1
                                                         : options_.max_samples;
  }

  RotationFromBearingsOptions<S> options_;
  std::array<BearingPair<S>, kCapacity> pairs_;
  std::size_t size_;
};

}  // namespace detail

// min over R_10 of  sum |x1/|x1| - R_10 x0/|x0||^2  over the inliers; the same seed gives the same answer.
// `inliers` (empty, or one flag a match) is written on success alone.
template <Scalar S>
[[nodiscard]] RotationFromBearings<S> rotation_from_bearings(std::span<const BearingMatch<S>> matches,
                                                             const RotationFromBearingsOptions<S>& options,
                                                             std::uint64_t seed,
                                                             std::span<std::uint8_t> inliers = {}) noexcept {
  RotationFromBearings<S> result;
  const auto refuse = [&](Status status) {
    result.status = status;
    return result;
  };
  if (!all_finite(matches)) return refuse(Status::kNotFinite);
  if (static_cast<int>(matches.size()) < std::max(options.min_inliers, 2)) return result;

  Random random(seed);
  SO3<S> R = detail::RotationSearch<S>(matches, options, random).run(random);
  const S gate = options.max_error * options.max_error;
  const auto tally = [&] {
    const Mat3<S> matrix = R.matrix();
    BearingEquations<S> equations;
    for (const BearingMatch<S>& match : matches) equations.add(BearingPair<S>(match), matrix, gate);
    return equations;
  };
  BearingEquations<S> sum = tally();
  for (int iteration = 0; iteration < 3 && sum.step(R); ++iteration) sum = tally();
  result.R_10 = R;
  result.inliers = sum.count;
  if (sum.count < options.min_inliers ||
      static_cast<S>(sum.count) < options.min_inlier_share * static_cast<S>(matches.size()))
    return refuse(Status::kNoConsensus);
  if (!inverse_of<S, 3>(sum.information, result.covariance)) return refuse(Status::kDegenerate);
  if (!(result.covariance.diagonal().maxCoeff() < options.max_sigma * options.max_sigma))
    return refuse(Status::kDegenerate);
  result.status = Status::kOk;
  if (inliers.size() != matches.size()) return result;
  const Mat3<S> matrix = R.matrix();
  for (std::size_t i = 0; i < matches.size(); ++i)
    inliers[i] = BearingPair<S>(matches[i]).squared_error(matrix) < gate;
  return result;
}

}  // namespace sslam
