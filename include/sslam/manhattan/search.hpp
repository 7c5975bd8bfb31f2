// SPDX-License-Identifier: BSD-3-Clause
// The first Manhattan frame, from any camera orientation: candidates over all of SO(3), scored by all votes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "sslam/manhattan/frame_candidates.hpp"
#include "sslam/manhattan/rotation.hpp"

namespace sslam {

template <Scalar S>
struct SearchOptions {
  ManhattanOptions<S> rotation;       // of the refinement of each candidate
  S rank_width = radians(S(7));       // kernel width of normals while candidates are compared
  S rank_line_floor = radians(S(1));  // added to the segments' sigma meanwhile
  S distinct = radians(S(6));         // frames closer than this (over the 24 namings) are the same
  int triples = 600;                  // random triples of segments
  S min_log_likelihood = 20;          // of an accepted frame over no structure: see find_manhattan
  S min_axis_gain = 8;                // the same, of an axis over none in its place; two axes must have it
  S max_ambiguity = S(0.9);           // an accepted frame is this much better than the next one that differs
};

namespace detail {

// Evenly spaced normals, copied so that each candidate is scored in microseconds.
template <Scalar S, std::size_t Capacity>
class NormalSample {
 public:
  template <Scalar V>
  explicit NormalSample(const NormalView<V>& normals) noexcept : size_(std::min(normals.size, Capacity)) {
    for (std::size_t i = 0; i < size_; ++i) {
      const std::size_t at = (i * normals.size / size_) * normals.stride;
      x_[i] = static_cast<S>(normals.x[at]);
      y_[i] = static_cast<S>(normals.y[at]);
      z_[i] = static_cast<S>(normals.z[at]);
      weight_[i] = normals.weight != nullptr ? static_cast<S>(normals.weight[at]) : S(1);
    }
  }

  [[nodiscard]] NormalView<S> view() const noexcept {
    return {x_.data(), y_.data(), z_.data(), weight_.data(), size_, 1};
  }
  // Every `every`-th of them, without a copy.
  [[nodiscard]] NormalView<S> thinned(std::size_t every) const noexcept {
    return {x_.data(), y_.data(), z_.data(), weight_.data(), (size_ + every - 1) / every, every};
  }

 private:
  std::size_t size_;
  std::array<S, Capacity> x_, y_, z_, weight_;
};

// The segments with the smallest sigma: the longest ones make the best vanishing points.
template <Scalar S, std::size_t Capacity>
[[nodiscard]] InlineVector<LineVote<S>, Capacity> sharpest_lines(
    std::span<const LineVote<S>> lines) noexcept {
  InlineVector<LineVote<S>, Capacity> chosen;
  const auto blunter = [](const LineVote<S>& a, const LineVote<S>& b) { return a.sigma < b.sigma; };
  for (const LineVote<S>& line : lines) {
    if (chosen.full()) {
      if (line.sigma >= chosen[0].sigma) continue;
      std::pop_heap(chosen.begin(), chosen.end(), blunter);
      chosen.pop_back();
    }
    (void)chosen.push_back(line);
    std::push_heap(chosen.begin(), chosen.end(), blunter);
  }
  return chosen;
}

// A candidate after its own refinement, with the likelihood of normals (at the width they ask for) and
// segments.
template <Scalar S>
[[nodiscard]] FrameScore<S> score_estimate(const ManhattanEstimate<S>& estimate, const NormalView<S>& normals,
                                           const ManhattanOptions<S>& options) noexcept {
  S scatter = 0;
  S share = 0;
  for (const AxisSupport<S>& axis : estimate.axes) {
    scatter += axis.normal_share * axis.normal_scatter;
    share += axis.normal_share;
  }
  const S wanted = share > S(0) ? options.kernel_per_scatter * scatter / share : options.widest_kernel;
  const S width = std::clamp(wanted, options.narrowest_kernel, options.widest_kernel);
  FrameScore<S> score =
      score_normals(normals, estimate.cam_from_manhattan.matrix(), width, options.normal_votes);
  score.total += estimate.log_likelihood;
  for (std::size_t k = 0; k < 3; ++k) score.gain[k] += estimate.axes[k].line_gain;
  return score;
}

// The best of the refined frames on all votes, and whether it may be believed.
template <Scalar S, Scalar V, std::size_t Capacity>
[[nodiscard]] ManhattanEstimate<S> accept_best(const NormalView<V>& normals, const NormalView<S>& sample,
                                               std::span<const LineVote<S>> lines,
                                               const CandidateList<S, Capacity>& refined,
                                               const SearchOptions<S>& options,
                                               std::span<std::int8_t> axis_of) noexcept {
  if (refined.size() == 0) return refusal(Status::kNoConsensus, ManhattanPrior<S>{});
  std::size_t best = 0;
  for (std::size_t i = 1; i < refined.size(); ++i) {
    if (refined[i].score > refined[best].score) best = i;
  }
  S second = 0;
  for (std::size_t i = 0; i < refined.size(); ++i) {
    if (i != best) second = std::max(second, refined[i].score);
  }
  const ManhattanPrior<S> start{closest_naming(refined[best].frame, SO3<S>())};
  ManhattanEstimate<S> estimate = track_manhattan<S, V>(normals, lines, start, options.rotation, axis_of);
  const FrameScore<S> score = score_estimate(estimate, sample, options.rotation);
  estimate.log_likelihood = score.total;
  estimate.ambiguity = score.total > S(0) ? second / score.total : S(1);
  if (!usable(estimate.status)) return estimate;
  int sure = 0;
  for (const S gain : score.gain) sure += gain >= options.min_axis_gain ? 1 : 0;
  if (score.total < options.min_log_likelihood || sure == 0 || estimate.ambiguity > options.max_ambiguity) {
    estimate.status = Status::kNoConsensus;
  } else if (sure == 1) {
    estimate.status = Status::kDegenerate;
  }
  return estimate;
}

}  // namespace detail

// A Manhattan frame from votes alone; its axes are named so that the rotation is closest to the identity.
//
// A frame is accepted against chance: the likelihood ratio of votes without structure has mean 1 for any one
// frame, and about exp(13) frames can be told apart, so a log-likelihood of 20 comes up by chance once in
// exp(7) views. kTooFew: no votes. kDegenerate: only one axis stands out. kNoConsensus: no frame does, or two
// that differ do equally well (see ambiguity). With these the rotation is the best guess, not to be used.
// Entry i of `axis_of`, if it is not empty, becomes the axis of segment i, or -1.
template <Scalar S, Scalar V = S>
[[nodiscard]] ManhattanEstimate<S> find_manhattan(const NormalView<V>& normals,
                                                  std::span<const LineVote<S>> lines,
                                                  const SearchOptions<S>& options, std::uint64_t seed,
                                                  std::span<std::int8_t> axis_of = {}) noexcept {
  constexpr std::size_t kRefined = 16;
  for (std::int8_t& axis : axis_of) axis = -1;
  const S total = total_weight<S>(normals);
  if (!std::isfinite(total) || !detail::all_finite(lines)) {
    return detail::refusal(Status::kNotFinite, ManhattanPrior<S>{});
  }
  if (!(total > S(0)) && lines.size() < 3) return detail::refusal(Status::kTooFew, ManhattanPrior<S>{});

  const detail::NormalSample<S, 2048> sample(normals);
  const auto sharp = detail::sharpest_lines<S, 64>(lines);
  Random random(seed);
  DirectionList<S> peaks;
  if (total > S(0)) peaks = find_peaks(sample.view(), options.rank_width, radians(S(20)), random);
  CandidateList<S, kRefined> candidates(options.distinct);
  propose_frames<S>(peaks, sharp, options.triples, random, [&](const SO3<S>& frame) {
    const Mat3<S> axes = frame.matrix();
    const S score =
        score_normals(sample.thinned(4), axes, options.rank_width, options.rotation.normal_votes).total +
        score_lines<S>(sharp, axes, options.rank_line_floor);
    candidates.offer(frame, score);
  });

  CandidateList<S, kRefined> refined(options.distinct);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const ManhattanPrior<S> start{candidates[i].frame};
    const ManhattanEstimate<S> estimate =
        track_manhattan<S, S>(sample.view(), lines, start, options.rotation);
    refined.offer(estimate.cam_from_manhattan,
                  detail::score_estimate(estimate, sample.view(), options.rotation).total);
  }
  return detail::accept_best<S, V>(normals, sample.view(), lines, refined, options, axis_of);
}

}  // namespace sslam
