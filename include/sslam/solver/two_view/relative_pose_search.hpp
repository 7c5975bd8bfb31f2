// SPDX-License-Identifier: BSD-3-Clause
// Search for a relative pose among mismatches: five matches and a start near the rotation that explains most
// bearings give hypotheses, found by iteration instead of a polynomial.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "sslam/core/parameter.hpp"
#include "sslam/solver/two_view/relative_pose.hpp"
#include "sslam/solver/two_view/rotation_from_bearings.hpp"
#include "sslam/solver/two_view/stratified_sample.hpp"

namespace sslam {

template <Scalar S>
struct FindRelativePoseOptions {
  RotationFromBearingsOptions<S> rotation{.min_inlier_share = S(0.1)};
  RelativePoseOptions<S> refinement;
  int max_samples = 300;    // sets of five matches tried at most
  S confidence = S(0.999);  // that one of the sets is free of mismatches
  S min_cost_gap =
      30;  // between the two answers of a nearly flat scene: three matches more or less, variances

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_samples", self.max_samples, Unit::kCount, 1, 1e6, "sets of five matches tried at most");
    visit("confidence", self.confidence, Unit::kShare, 0, 1, "that one of them is free of mismatches");
    visit("min_cost_gap", self.min_cost_gap, Unit::kNumber, 0, 1e6,
          "between the two answers of a nearly flat scene, variances");
    visit_within("rotation.", self.rotation, visit);
    visit_within("refinement.", self.refinement, visit);
  }
};
static_assert(Described<FindRelativePoseOptions<double>>);

// Search over sets of five matches (iterative minimal solver: Rosten, Reitmayr and Drummond, ICRA 2010).
template <Scalar S>
class RelativePoseSearch {
 public:
  static constexpr std::size_t kCapacity = 256;
  static constexpr std::size_t kMinimal = 5;

  RelativePoseSearch(std::span<const BearingMatch<S>> matches, const FindRelativePoseOptions<S>& options,
                     Random& random) noexcept
      : matches_(matches), options_(options), size_(std::min(matches.size(), kCapacity)) {
    for (std::size_t slot = 0; slot < size_; ++slot) {
      sample_[slot] = static_cast<std::uint32_t>(stratified_index(slot, size_, matches.size(), random));
    }
  }

  // False when no set of five led anywhere.
  [[nodiscard]] bool run(const SO3<S>& start, Random& random, RelativePose<S>& best) const noexcept {
    S score = std::numeric_limits<S>::max();
    int budget = options_.max_samples;
    for (int k = 0; k < budget; ++k) {
      std::array<std::uint32_t, kMinimal> set;
      if (!draw(random, set)) continue;
      // Half of the sets start from the best so far: its rotation is nearer than the first guess.
      RelativePose<S> pose{k % 2 == 1 && score < std::numeric_limits<S>::max() ? best.R_10 : start, {}};
      if (!start_direction(set, pose) || !solve(set, pose)) continue;
      S trial = cost(pose, score);
      if (!(trial < score)) continue;
      improve(pose, trial);
      score = trial;
      best = pose;
      budget = std::min(budget, samples_needed(best));
    }
    return score < std::numeric_limits<S>::max();
  }

 private:
  [[nodiscard]] bool draw(Random& random, std::array<std::uint32_t, kMinimal>& set) const noexcept {
    for (std::size_t i = 0; i < kMinimal; ++i) {
      set[i] = sample_[random.below(static_cast<std::uint32_t>(size_))];
      for (std::size_t j = 0; j < i; ++j)
        if (set[i] == set[j]) return false;
    }
    return true;
  }

  // The null vector of the five linear equations at the start rotation.
  [[nodiscard]] bool start_direction(std::span<const std::uint32_t> set,
                                     RelativePose<S>& pose) const noexcept {
    const Mat3<S> R = pose.R_10.matrix();
    FlowSystem<S> system;
    Flow<S> flow;
    for (const std::uint32_t i : set)
      if (compensate(R, matches_[i], S(0), flow)) system.add(flow);
    FlowSolution<S> solution;
    if (!system.solve(solution)) return false;
    pose.t_10 = solution.best;
    return true;
  }

  // Gauss-Newton on the epipolar errors of the set, until they vanish; then the sign of t.
  [[nodiscard]] bool solve(std::span<const std::uint32_t> set, RelativePose<S>& pose) const noexcept {
    constexpr int kIterations = 8;
    S error = std::numeric_limits<S>::max();
    for (int iteration = 0; iteration < kIterations && error > S(0.3); ++iteration)
      if (!step(linearize(set, pose, std::numeric_limits<S>::max()), pose) ||
          !largest_error(set, pose, error))
        return false;
    if (!(error < 1)) return false;
    const Mat3<S> R = pose.R_10.matrix();
    S front = 0;
    Flow<S> flow;
    for (const std::uint32_t i : set)
      if (compensate(R, matches_[i], S(0), flow))
        front += std::clamp(epipolar_fit(flow, pose.t_10).along, S(-3), S(3));
    if (front < 0) pose.t_10 = -pose.t_10;
    return true;
  }

  [[nodiscard]] bool largest_error(std::span<const std::uint32_t> set, const RelativePose<S>& pose,
                                   S& error) const noexcept {
    const Mat3<S> R = pose.R_10.matrix();
    error = 0;
    for (const std::uint32_t i : set)
      error = std::max(error, std::abs(epipolar_residual(R, pose.t_10, matches_[i])));
    return std::isfinite(error);
  }

  [[nodiscard]] NormalEquations<S, 5> linearize(std::span<const std::uint32_t> set,
                                                const RelativePose<S>& pose,
                                                S max_squared_error) const noexcept {
    const Mat3<S> R = pose.R_10.matrix();
    const Mat<S, 3, 2> basis = tangent_basis(pose.t_10);
    NormalEquations<S, 5> equations;
    Flow<S> flow;
    for (const std::uint32_t i : set) {
      if (max_squared_error < std::numeric_limits<S>::max() &&
          !(compensate(R, matches_[i], S(0), flow) && squared_error(flow, pose.t_10) < max_squared_error))
        continue;
      const EpipolarRow<S> row = epipolar_row(R, pose.t_10, matches_[i]);
      Mat<S, 1, 5> j;
      j << row.wrt_rotation.transpose(), row.wrt_translation.transpose() * basis;
      equations.add(j, row.residual, S(1));
    }
    equations.complete();
    return equations;
  }

  [[nodiscard]] static bool step(const NormalEquations<S, 5>& equations, RelativePose<S>& pose) noexcept {
    constexpr S kDamping = S(1e-4);
    constexpr S kLongestTurn = S(0.2), kLongestSwing = S(0.7);  // rad
    Mat<S, 5, 5> H = equations.H;
    H.diagonal() *= 1 + kDamping;
    H.diagonal().array() += 1;  // an error of one standard deviation may stay for each rad
    const Eigen::LLT<Mat<S, 5, 5>> factor(H);
    if (factor.info() != Eigen::Success) return false;
    Vec<S, 5> delta = -factor.solve(equations.g);
    const S excess = std::max(delta.template head<3>().norm() / kLongestTurn,
                              delta.template tail<2>().norm() / kLongestSwing);
    if (!std::isfinite(excess)) return false;
    if (excess > 1) delta /= excess;
    pose = pose.retract(delta);
    return true;
  }

  // Truncated squared error, summed over the sample; stops above `limit`.
  [[nodiscard]] S cost(const RelativePose<S>& pose, S limit) const noexcept {
    const Mat3<S> R = pose.R_10.matrix();
    const S outlier = options_.refinement.max_error * options_.refinement.max_error;
    S sum = 0;
    Flow<S> flow;
    for (std::size_t i = 0; i < size_ && sum < limit; ++i)
      sum += compensate(R, matches_[sample_[i]], S(0), flow)
                 ? std::min(squared_error(flow, pose.t_10), outlier)
                 : outlier;
    return sum;
  }

  void improve(RelativePose<S>& pose, S& score) const noexcept {
    const S gate = options_.refinement.max_error * options_.refinement.max_error;
    for (int round = 0; round < 4; ++round) {
      RelativePose<S> better = pose;
      if (!step(linearize({sample_.data(), size_}, pose, gate * 2), better)) return;
      const S trial = cost(better, score);
      if (!(trial < score)) return;
      pose = better;
      score = trial;
    }
  }

  [[nodiscard]] int samples_needed(const RelativePose<S>& pose) const noexcept {
    const Mat3<S> R = pose.R_10.matrix();
    const S gate = options_.refinement.max_error * options_.refinement.max_error;
    int good = 0;
    Flow<S> flow;
    for (std::size_t i = 0; i < size_; ++i)
      good += compensate(R, matches_[sample_[i]], S(0), flow) && squared_error(flow, pose.t_10) < gate;
    const S share = static_cast<S>(good) / static_cast<S>(size_);
    const S clean = share * share * share * share * share / 2;  // every other clean set does not converge
    const S needed = std::log1p(-options_.confidence) / std::log1p(-clean);
    return needed < static_cast<S>(options_.max_samples) ? static_cast<int>(needed) + 1
                                                         : options_.max_samples;
  }

  std::span<const BearingMatch<S>> matches_;
  const FindRelativePoseOptions<S>& options_;
  std::array<std::uint32_t, kCapacity> sample_;
  std::size_t size_;
};

}  // namespace sslam
