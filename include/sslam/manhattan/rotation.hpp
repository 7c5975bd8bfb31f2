// SPDX-License-Identifier: BSD-3-Clause
// Tracking of the Manhattan rotation. Normals give a start close enough to converge, and name the axes;
// segments determine the last degrees.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "sslam/manhattan/cube.hpp"
#include "sslam/manhattan/frame_refiner.hpp"
#include "sslam/manhattan/turned_start.hpp"
#include "sslam/solver/least_squares/positive_inverse.hpp"

namespace sslam {

namespace detail {

template <Scalar S, Scalar V>
struct FrameVotes {
  NormalView<V> normals;
  S total = 0;  // weight of the normals
  std::span<const LineVote<S>> lines;

  FrameVotes(const NormalView<V>& n, std::span<const LineVote<S>> l) noexcept
      : normals(n), total(total_weight<S>(n)), lines(l) {}

  [[nodiscard]] bool empty() const noexcept { return !(total > S(0)) && lines.empty(); }
  // No NaN or infinity, and nothing far too long for a unit vector.
  [[nodiscard]] bool sound() const noexcept {
    bool all = std::isfinite(total);
    for (const LineVote<S>& line : lines)
      all = all && line.plane_normal.squaredNorm() < S(4) && line.ray.squaredNorm() < S(4) &&
            std::isfinite(line.sigma);
    return all;
  }
};

// From a start, which may differ from the prior, to the nearest frame.
template <Scalar S, Scalar V>
[[nodiscard]] ManhattanEstimate<S> climb(const FrameVotes<S, V>& votes, const SO3<S>& start,
                                         const ManhattanPrior<S>& prior, const Mat3<S>& prior_information,
                                         const ManhattanOptions<S>& options, LineShares<S>& shares) noexcept {
  NormalModes<S> modes;
  modes.cam_from_axes = start;
  if (votes.total > S(0)) modes = find_normal_modes(votes.normals, votes.total, start, options);
  const auto refine = [&](LineShares<S>& found) {
    return FrameRefiner<S>(modes, votes.lines, prior, prior_information, options).run(found);
  };
  ManhattanEstimate<S> estimate = refine(shares);
  if (votes.lines.empty() || !(angle_between(modes.cam_from_axes, start) > options.widest_line_gate))
    return estimate;
  // The normals led farther away than segments can correct. They are wrong if the segments agree at the
  // start.
  modes.cam_from_axes = start;
  LineShares<S> shares_at_start;
  const ManhattanEstimate<S> at_start = refine(shares_at_start);
  if (at_start.log_likelihood > estimate.log_likelihood + options.min_line_gain) {
    estimate = at_start;
    shares = shares_at_start;
  }
  return estimate;
}

template <Scalar S>
[[nodiscard]] ManhattanEstimate<S> refusal(Status status, const ManhattanPrior<S>& prior = {}) noexcept {
  ManhattanEstimate<S> estimate;
  estimate.status = status;
  estimate.cam_from_manhattan = prior.cam_from_manhattan;
  estimate.covariance = prior.covariance;
  return estimate;
}

template <Scalar S>
void assign_lines_of(const ManhattanEstimate<S>& estimate, std::span<const LineVote<S>> lines,
                     const LineShares<S>& shares, S floor, std::span<std::int8_t> axis_of) noexcept {
  std::array<bool, 3> named{};
  for (std::size_t k = 0; k < 3; ++k) named[k] = estimate.axes[k].by_lines;
  assign_lines(lines, estimate.cam_from_manhattan.matrix(), shares, floor, named, axis_of);
}

}  // namespace detail

// The rotation of a Manhattan frame near the prior, from normals, segments or both (method: Li, Brasch, Wang,
// Navab, Tombari, Structure-SLAM, RA-L 2020, III-B, with segments as great circles and a refinement on
// SO(3)).
//
// kOk: every rotation is observed by votes. kDegenerate: only some are (one axis); the rest keeps the prior's
// value and covariance. kTooFew: no votes. kNoConsensus: no axis stands out, or the votes would turn the
// prior by more than max_jump. kNotFinite: a NaN or infinity in votes or prior, a direction longer than 2 (it
// should be 1), or a prior whose covariance has no inverse. With the last three, the result is the prior (the
// identity if the prior is not finite). Entry i of `axis_of`, if it is not empty, becomes the axis (0, 1, 2)
// of segment i, or -1.
template <Scalar S, Scalar V = S>
[[nodiscard]] ManhattanEstimate<S> track_manhattan(const NormalView<V>& normals,
                                                   std::span<const LineVote<S>> lines,
                                                   const ManhattanPrior<S>& prior,
                                                   const ManhattanOptions<S>& options = {},
                                                   std::span<std::int8_t> axis_of = {}) noexcept {
  for (std::int8_t& axis : axis_of) axis = -1;
  if (!prior.covariance.allFinite() || !prior.cam_from_manhattan.matrix().allFinite())
    return detail::refusal<S>(Status::kNotFinite);
  Mat3<S> information;
  if (!inverse_of<S, 3>(prior.covariance, information)) return detail::refusal(Status::kNotFinite, prior);
  const detail::FrameVotes<S, V> votes(normals, lines);
  if (!votes.sound()) return detail::refusal(Status::kNotFinite, prior);
  if (votes.empty()) return detail::refusal(Status::kTooFew, prior);

  LineShares<S> shares;
  ManhattanEstimate<S> estimate =
      detail::climb(votes, prior.cam_from_manhattan, prior, information, options, shares);
  if (!usable(estimate.status)) {
    LineShares<S> other_shares;
    const SO3<S> start = best_turned_start(normals, lines, estimate, prior, information, options);
    const ManhattanEstimate<S> other = detail::climb(votes, start, prior, information, options, other_shares);
    if (other.axes_seen > estimate.axes_seen) {
      estimate = other;
      shares = other_shares;
    }
  }
  const S turn = angle_between(estimate.cam_from_manhattan, prior.cam_from_manhattan);
  if (estimate.status == Status::kNoConsensus || !(turn <= options.max_jump))
    return detail::refusal(Status::kNoConsensus, prior);
  detail::assign_lines_of(estimate, lines, shares, options.line_floor, axis_of);
  return estimate;
}

}  // namespace sslam
