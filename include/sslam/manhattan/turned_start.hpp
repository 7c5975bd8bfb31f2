// SPDX-License-Identifier: BSD-3-Clause
// Other starts for a frame that the votes near the prior do not determine: turns about the axes that are
// seen.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "sslam/manhattan/cube.hpp"
#include "sslam/manhattan/estimate.hpp"
#include "sslam/manhattan/frame_score.hpp"

namespace sslam {

// While a camera sees one axis only, turns about it are not observed. When the next wall comes into view, the
// rotation may be too far off for a local search. This tries turns of up to 40 degrees about each axis that
// is seen (about all three if none is), and returns the one with the best posterior: likelihood of all votes
// times the prior.
template <Scalar S, Scalar V>
[[nodiscard]] SO3<S> best_turned_start(const DirectionView<V>& normals, std::span<const LineVote<S>> lines,
                                       const ManhattanEstimate<S>& loose, const ManhattanPrior<S>& prior,
                                       const Mat3<S>& prior_information,
                                       const ManhattanOptions<S>& options) noexcept {
  constexpr int kTurns = 5;
  constexpr S kTurn = radians(S(8));
  constexpr std::size_t kEnough = 4096;  // number of normals for the score of one start
  const std::size_t every = 1 + normals.size / kEnough;
  const auto posterior = [&](const SO3<S>& frame) {
    const Vec3<S> off = (frame * prior.cam_from_manhattan.inverse()).log();
    const Mat3<S> axes = frame.matrix();
    return score_normals<S>(normals, axes, options.widest_kernel, options.normal_votes, every) +
           score_lines(lines, axes, kTurn / S(4)) - S(0.5) * off.dot(prior_information * off);
  };
  SO3<S> best = loose.cam_from_manhattan;
  S best_score = posterior(best);
  for (int k = 0; k < 3; ++k) {
    if (loose.axes_seen > 0 && !loose.axes[static_cast<std::size_t>(k)].seen) continue;
    for (int i = -kTurns; i <= kTurns; ++i) {
      if (i == 0) continue;
      const SO3<S> turned =
          loose.cam_from_manhattan * SO3<S>::exp(Vec3<S>(Vec3<S>::Unit(k) * (static_cast<S>(i) * kTurn)));
      const S score = posterior(turned);
      if (!(score > best_score)) continue;
      best_score = score;
      best = turned;
    }
  }
  return closest_naming(best, prior.cam_from_manhattan);
}

}  // namespace sslam
