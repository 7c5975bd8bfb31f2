// SPDX-License-Identifier: BSD-3-Clause
// The first Manhattan frame, from any camera orientation: candidates over all of SO(3), scored by all votes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "sslam/core/parameter.hpp"
#include "sslam/manhattan/frame_candidates.hpp"
#include "sslam/manhattan/rotation.hpp"

namespace sslam {

template <Scalar S>
struct SearchOptions {
  ManhattanOptions<S> rotation;       // for the refinement of each candidate
  S rank_width = radians(S(7));       // kernel width of normals while candidates are compared
  S rank_line_floor = radians(S(1));  // added to the segments' sigma at that stage
  int pairs = 600;                    // random pairs of segments whose intersection is tried
  S peaks_apart = radians(S(20));     // between two peaks of the normals
  S points_apart = radians(S(8));     // between two vanishing points
  S distinct = radians(S(6));         // frames closer than this (over the 24 ways to name axes) are the same

  // Conditions for accepting a frame. Log-likelihoods are relative to votes without structure.
  S min_surprise = 7;        // of the whole frame, above the best that chance would find
  S min_axis_gain = 8;       // of an axis over clutter in its place; two axes must have it
  S max_skew = 2;            // of a plane's direction off its axis, in its standard deviations
  S max_ambiguity = S(0.9);  // of the next best frame that differs, as a share of the best

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("rank_width", self.rank_width, Unit::kDegrees, 0.01, 45,
          "kernel width of normals while candidates are compared");
    visit("rank_line_floor", self.rank_line_floor, Unit::kDegrees, 0, 45,
          "added to the sigma of the segments meanwhile");
    visit("pairs", self.pairs, Unit::kCount, 0, 1e6,
          "random pairs of segments whose vanishing point is tried");
    visit("peaks_apart", self.peaks_apart, Unit::kDegrees, 0, 90, "between two peaks of the normals");
    visit("points_apart", self.points_apart, Unit::kDegrees, 0, 90, "between two vanishing points");
    visit("distinct", self.distinct, Unit::kDegrees, 0, 45, "between two frames that differ");
    visit("min_surprise", self.min_surprise, Unit::kNumber, 0, 1e6,
          "log-likelihood of the frame beyond what chance would find");
    visit("min_axis_gain", self.min_axis_gain, Unit::kNumber, 0, 1e6,
          "log-likelihood of an axis over clutter in its place");
    visit("max_skew", self.max_skew, Unit::kNumber, 0, 1e6,
          "of a plane's direction off its axis, standard deviations");
    visit("max_ambiguity", self.max_ambiguity, Unit::kShare, 0, 1,
          "of the next best frame as a share of the best");
    // `rotation` serves every frame: the stage that searches lists its parameters under its own names.
  }
};
static_assert(Described<SearchOptions<double>>);

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

// A refined candidate with the log-likelihood of normals (at the kernel width that suits their scatter) and
// segments.
template <Scalar S>
struct ScoredFrame {
  ManhattanEstimate<S> estimate;
  LineShares<S> shares;
  S score = 0;
  std::array<S, 3> gain{};  // loss without each axis
};

template <Scalar S, Scalar V>
[[nodiscard]] ScoredFrame<S> refine_candidate(const FrameVotes<S, V>& votes, const NormalView<S>& sample,
                                              const SO3<S>& start,
                                              const ManhattanOptions<S>& options) noexcept {
  const ManhattanPrior<S> prior{start};
  const Mat3<S> information = prior.covariance.diagonal().cwiseInverse().asDiagonal();
  ScoredFrame<S> found;
  found.estimate = climb(votes, start, prior, information, options, found.shares);
  S scatter = 0;
  S share = 0;
  for (const AxisSupport<S>& axis : found.estimate.axes) {
    scatter += axis.normal_share * axis.normal_scatter;
    share += axis.normal_share;
  }
  const S wanted = share > S(0) ? options.kernel_per_scatter * scatter / share : options.widest_kernel;
  const S width = std::clamp(wanted, options.narrowest_kernel, S(2) * options.widest_kernel);
  const Mat3<S> axes = found.estimate.cam_from_manhattan.matrix();
  found.score = found.estimate.log_likelihood +
                score_normals(sample, axes, width, options.normal_votes, 1, &found.gain);
  for (std::size_t k = 0; k < 3; ++k) found.gain[k] += found.estimate.axes[k].line_gain;
  return found;
}

// Whether the best frame is accepted.
template <Scalar S>
[[nodiscard]] Status judge(const ScoredFrame<S>& best, const SearchOptions<S>& options) noexcept {
  if (!usable(best.estimate.status)) return best.estimate.status;
  // Number of distinguishable frames: the volume of SO(3), up to the 24 ways to name the axes, over that of
  // the result's uncertainty.
  constexpr S kVolume = S(3.29);   // 8 pi^2 / 24, rad^3
  constexpr S kNormal = S(15.75);  // (2 pi)^(3/2)
  const S spread = kNormal * std::sqrt(std::max(best.estimate.covariance.determinant(), S(1e-30)));
  const S chance = std::max(S(0), std::log(kVolume / spread));
  int sure = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const AxisSupport<S>& axis = best.estimate.axes[k];
    const bool square = axis.by_lines || axis.mode.norm() <= options.max_skew * axis.mode_sigma;
    sure += best.gain[k] >= options.min_axis_gain && square ? 1 : 0;
  }
  if (best.score - chance < options.min_surprise || sure == 0 ||
      best.estimate.ambiguity > options.max_ambiguity)
    return Status::kNoConsensus;
  return sure == 1 ? Status::kDegenerate : Status::kOk;
}

}  // namespace detail

// A Manhattan frame from votes alone; its axes are named so that the rotation is closest to the identity.
//
// A frame is accepted against chance: the likelihood ratio of votes without structure has mean 1 for any one
// frame, so chance finds the log-likelihood s among N distinct frames with odds N exp(-s) at most (Markov); N
// is the volume of SO(3), up to the 24 ways to name the axes, over that of the result's covariance. Two
// planes that happen to meet at a right angle, within the precision of their normals, count as a frame.
//
// kTooFew: no votes. kDegenerate: at most one axis stands out, as with a single plane in view. kNoConsensus:
// several directions stand out but no frame does, or two different frames do equally well (see ambiguity).
// kNotFinite: as in track_manhattan. With these, do not use the rotation. Entry i of `axis_of`, if it is not
// empty, becomes the axis of segment i, or -1.
template <Scalar S, Scalar V = S>
[[nodiscard]] ManhattanEstimate<S> find_manhattan(const NormalView<V>& normals,
                                                  std::span<const LineVote<S>> lines,
                                                  const SearchOptions<S>& options, std::uint64_t seed,
                                                  std::span<std::int8_t> axis_of = {}) noexcept {
  constexpr std::size_t kRefined = 16;
  for (std::int8_t& axis : axis_of) axis = -1;
  const detail::FrameVotes<S, V> votes(normals, lines);
  if (!votes.sound()) return detail::refusal<S>(Status::kNotFinite);
  if (!(votes.total > S(0)) && lines.size() < 3) return detail::refusal<S>(Status::kTooFew);

  const detail::NormalSample<S, 2048> sample(normals);
  const NormalView<S> view = sample.view();
  const auto sharp = detail::sharpest_lines<S, 64>(lines);
  Random random(seed);
  DirectionList<S> directions;
  if (votes.total > S(0)) find_peaks(view, options.rank_width, options.peaks_apart, random, directions);
  find_vanishing_points<S>(sharp, options.pairs, options.rank_line_floor, options.points_apart, random,
                           directions);
  const auto same = [&options](const SO3<S>& a, const SO3<S>& b) {
    return angle_between_frames(a, b) < options.distinct;
  };
  using FrameList = BestDistinct<SO3<S>, S, kRefined, decltype(same)>;
  FrameList candidates(same);
  propose_frames<S>(directions, sharp, [&](const SO3<S>& frame) {
    const Mat3<S> axes = frame.matrix();
    const S by_normals = score_normals(view, axes, options.rank_width, options.rotation.normal_votes, 4);
    candidates.offer(frame, by_normals + score_lines<S>(sharp, axes, options.rank_line_floor));
  });
  if (candidates.size() == 0)
    return detail::refusal<S>(directions.size() == 1 ? Status::kDegenerate : Status::kNoConsensus);

  FrameList refined(same);
  const detail::FrameVotes<S, S> thin(view, lines);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto found = detail::refine_candidate(thin, view, candidates[i].item, options.rotation);
    refined.offer(found.estimate.cam_from_manhattan, found.score);
  }
  const std::size_t top = refined.best();
  const SO3<S> start = closest_naming(refined[top].item, SO3<S>());
  detail::ScoredFrame<S> best = detail::refine_candidate(votes, view, start, options.rotation);
  const S second = refined.second_best_score();
  best.estimate.log_likelihood = best.score;
  best.estimate.ambiguity = best.score > S(0) ? second / best.score : S(1);
  best.estimate.status = detail::judge(best, options);
  if (usable(best.estimate.status))
    detail::assign_lines_of(best.estimate, lines, best.shares, options.rotation.line_floor, axis_of);
  return best.estimate;
}

}  // namespace sslam
