// SPDX-License-Identifier: BSD-3-Clause
// Segments against three axes: which segment belongs to which axis (a mixture with clutter), and the cost of
// moving each axis.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>

#include "sslam/geometry/so3.hpp"
#include "sslam/manhattan/votes.hpp"

namespace sslam {

// Quadratic cost 1/2 d^T H d + g^T d of moving axis k by d = (d_i, d_j), radians along axes i = k+1 and j =
// k+2.
template <Scalar S>
struct AxisSystem {
  Mat2<S> H = Mat2<S>::Zero();
  Vec2<S> g = Vec2<S>::Zero();
};

// Shares of segments that belong to each axis; the rest is clutter.
template <Scalar S>
struct LineShares {
  std::array<S, 3> axis{S(0.2), S(0.2), S(0.2)};

  [[nodiscard]] S clutter() const noexcept { return S(1) - axis[0] - axis[1] - axis[2]; }
};

// The result of one pass over all segments.
template <Scalar S>
struct LineRound {
  std::array<AxisSystem<S>, 3> systems{};
  std::array<S, 3> count{};    // sum of the probabilities to belong to axis k
  std::array<S, 3> gain{};     // log-likelihood of all segments over that with axis k counted as clutter
  std::array<S, 3> squared{};  // sum of probability times squared residual over its variance
  S log_likelihood = 0;        // of all segments, over that of clutter alone
};

namespace detail {

template <Scalar S>
struct CircleRatio {
  S inverse_variance;  // of the residual
  S ratio;             // likelihood of the axis over that of clutter
};

// Through a given pixel, clutter has any direction with equal probability, density 1 / pi. A segment of axis
// a has the turn psi = r / sin(alpha), where alpha is the angle from the ray to a, and r = n . a is normally
// distributed with variance sigma^2 sin^2(alpha) + floor^2. `along` is the cosine of alpha.
template <Scalar S>
[[nodiscard]] CircleRatio<S> circle_ratio(S sigma, S residual, S along, S floor) noexcept {
  const S sine2 = std::max(S(1) - along * along, S(0));
  const S inverse_variance = S(1) / (sigma * sigma * sine2 + floor * floor + S(1e-12));
  const S density = std::sqrt(sine2 * inverse_variance * (std::numbers::pi_v<S> / S(2)));
  return {inverse_variance, density * std::exp(S(-0.5) * residual * residual * inverse_variance)};
}

// One segment against three axes, in their frame.
template <Scalar S>
struct LineLikelihood {
  Vec3<S> normal;  // of the interpretation plane: its entries are the residuals
  Vec3<S> inverse_variance;
  Vec3<S> ratio;

  LineLikelihood(const LineVote<S>& line, const Mat3<S>& cam_from_axes, S floor) noexcept
      : normal(cam_from_axes.transpose() * line.plane_normal) {
    const Vec3<S> ray = cam_from_axes.transpose() * line.ray;
    for (int k = 0; k < 3; ++k) {
      const CircleRatio<S> circle = circle_ratio(line.sigma, normal[k], ray[k], floor);
      inverse_variance[k] = circle.inverse_variance;
      ratio[k] = circle.ratio;
    }
  }
};

}  // namespace detail

// One E-step of the mixture and the normal equations of its M-step. `floor` (radians) is added to every
// sigma.
template <Scalar S>
[[nodiscard]] LineRound<S> weigh_lines(std::span<const LineVote<S>> lines, const Mat3<S>& cam_from_axes,
                                       const LineShares<S>& shares, S floor) noexcept {
  LineRound<S> round;
  const S clutter = shares.clutter();
  for (const LineVote<S>& line : lines) {
    const detail::LineLikelihood<S> like(line, cam_from_axes, floor);
    std::array<S, 3> part;
    S total = clutter;
    for (std::size_t k = 0; k < 3; ++k) total += part[k] = shares.axis[k] * like.ratio[static_cast<int>(k)];
    round.log_likelihood += std::log(total);
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const S probability = part[at] / total;
      round.count[at] += probability;
      round.gain[at] += std::log(total / (total - part[at] + shares.axis[at]));
      const S weight = probability * like.inverse_variance[k];
      const S residual = like.normal[k];
      round.squared[at] += weight * residual * residual;
      const Vec2<S> row(like.normal[(k + 1) % 3], like.normal[(k + 2) % 3]);
      AxisSystem<S>& system = round.systems[at];
      system.H += weight * row * row.transpose();
      system.g += weight * residual * row;
    }
  }
  return round;
}

// The M-step of the shares. Two imaginary clutter segments keep a few segments from all becoming inliers.
template <Scalar S>
[[nodiscard]] LineShares<S> update_shares(const LineRound<S>& round, std::size_t lines) noexcept {
  LineShares<S> shares;
  const S total = static_cast<S>(lines) + S(2) + S(1.5);
  for (std::size_t k = 0; k < 3; ++k) shares.axis[k] = (round.count[k] + S(0.5)) / total;
  return shares;
}

// Writes for each segment the axis (0, 1, 2) that it belongs to with a probability above one half, or -1.
// Only axes in `usable_axes` are written. Writes min(lines, axis_of) entries.
template <Scalar S>
void assign_lines(std::span<const LineVote<S>> lines, const Mat3<S>& cam_from_axes,
                  const LineShares<S>& shares, S floor, const std::array<bool, 3>& usable_axes,
                  std::span<std::int8_t> axis_of) noexcept {
  const std::size_t count = std::min(lines.size(), axis_of.size());
  for (std::size_t i = 0; i < count; ++i) {
    const detail::LineLikelihood<S> like(lines[i], cam_from_axes, floor);
    S total = shares.clutter();
    for (std::size_t k = 0; k < 3; ++k) total += shares.axis[k] * like.ratio[static_cast<int>(k)];
    axis_of[i] = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool likely = shares.axis[k] * like.ratio[static_cast<int>(k)] > S(0.5) * total;
      if (likely && usable_axes[k]) axis_of[i] = static_cast<std::int8_t>(k);
    }
  }
}

}  // namespace sslam
