// SPDX-License-Identifier: BSD-3-Clause
// Search for the direction of translation among mismatches: pairs of flows give hypotheses, a bounded sample
// of the matches scores them, and the linear system over the inliers improves each new best.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "sslam/core/random.hpp"
#include "sslam/solver/two_view/flow_sample.hpp"

namespace sslam {

template <Scalar S>
struct TranslationSearch {
  FlowGate<S> gate;
  int max_samples = 200;
  S confidence = S(0.999);

  // Truncated squared error, summed over the flows (MSAC: Torr and Zisserman 2000); stops early above
  // `limit`.
  [[nodiscard]] S cost(std::span<const Flow<S>> flows, const Vec3<S>& t_10, S limit) const noexcept {
    constexpr std::size_t kBlock = 32;
    const S outlier = gate.max_error * gate.max_error;
    S sum = 0;
    for (std::size_t begin = 0; begin < flows.size() && sum < limit; begin += kBlock) {
      const std::size_t end = std::min(begin + kBlock, flows.size());
      for (std::size_t i = begin; i < end; ++i) sum += std::min(squared_error(flows[i], t_10), outlier);
    }
    return sum;
  }

  // True, and t_10 of unit length, when any hypothesis could be made.
  [[nodiscard]] bool run(const FlowSample<S>& sample, Random& random, Vec3<S>& t_10) const noexcept {
    S best = std::numeric_limits<S>::max();
    int budget = max_samples;
    for (int k = 0; k < budget; ++k) {
      Vec3<S> t;
      if (!draw(sample, random, t)) continue;
      S score = cost(sample.view(), t, best);
      if (!(score < best)) continue;
      improve(sample.view(), t, score);
      best = score;
      t_10 = t;
      budget = std::min(budget, samples_needed(sample, t));
    }
    return best < std::numeric_limits<S>::max();
  }

 private:
  [[nodiscard]] static bool draw(const FlowSample<S>& sample, Random& random, Vec3<S>& t) noexcept {
    const auto count = static_cast<std::uint32_t>(sample.moved_count);
    const Flow<S>& a = sample.moved_flow(static_cast<int>(random.below(count)));
    const Flow<S>& b = sample.moved_flow(static_cast<int>(random.below(count)));
    t = a.normal.cross(b.normal);
    const S length = t.norm();
    if (!(length > S(1e-3) * a.normal.norm() * b.normal.norm())) return false;
    t *= (epipolar_fit(a, t).along < 0 ? S(-1) : S(1)) / length;
    return epipolar_fit(b, t).along > 0;
  }

  // A few reweighted solutions of the linear system, kept while they lower the cost.
  void improve(std::span<const Flow<S>> flows, Vec3<S>& t_10, S& score) const noexcept {
    for (int round = 0; round < 3; ++round) {
      FlowSystem<S> system;
      for (const Flow<S>& flow : flows)
        if (gate.accepts(flow, t_10)) system.add(flow);
      FlowSolution<S> solution;
      if (!system.solve(solution)) return;
      const Vec3<S> t = solution.best.dot(t_10) < 0 ? Vec3<S>(-solution.best) : solution.best;
      const S trial = cost(flows, t, score);
      if (!(trial < score)) return;
      t_10 = t;
      score = trial;
    }
  }

  // Pairs to draw until one of them is free of mismatches, with the given confidence.
  [[nodiscard]] int samples_needed(const FlowSample<S>& sample, const Vec3<S>& t_10) const noexcept {
    int good = 0;
    for (int i = 0; i < sample.moved_count; ++i) good += gate.accepts(sample.moved_flow(i), t_10);
    const S share = static_cast<S>(good) / static_cast<S>(sample.moved_count);
    const S failure = std::log1p(-std::min(share * share, S(0.99)));
    const S needed = std::log1p(-confidence) / failure;
    return needed < static_cast<S>(max_samples) ? static_cast<int>(needed) + 1 : max_samples;
  }
};

}  // namespace sslam
