// SPDX-License-Identifier: BSD-3-Clause
// How well a frame explains all votes: a log-likelihood over that of directions without any structure.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "sslam/manhattan/line_circles.hpp"
#include "sslam/solver/modes/mean_shift.hpp"

namespace sslam {

// The log-likelihood of the normals under a mixture of three kernels of the given width (radians, each a
// density on the sphere) and clutter: the mean over the normals, times the number of independent votes, which
// is `votes` or the number of normals if that is smaller. Over evenly spread directions, exp of one vote's
// score has mean 1, so exp(score) bounds the odds of chance (Markov). `gain`, if not null, gets the loss
// without each axis. With every > 1, only every n-th block of normals is read.
template <Scalar S, Scalar V>
[[nodiscard]] S score_normals(const DirectionView<V>& normals, const Mat3<S>& cam_from_axes, S width, S votes,
                              std::size_t every = 1, std::array<S, 3>* gain = nullptr) noexcept {
  constexpr V kShare = V(0.2);  // of each axis; the rest is clutter
  constexpr V kClutter = V(0.4);
  using Lanes = detail::DirectionLanes<V>;
  S score = 0;
  S weight = 0;
  S count = 0;
  std::array<S, 3> lost{};
  const Mat3<V> axes = cam_from_axes.template cast<V>();
  // Kernel mass over the plane is 12 pi h^2 / 5, over the half sphere 2 pi for clutter.
  const V peak = kShare * static_cast<V>(S(5) / (S(6) * width * width));
  const V inverse_cone = V(1) / static_cast<V>(squared_cone(width));
  detail::DirectionBlock<V> block;
  block.weight.setOnes();
  const std::size_t step = detail::kDirectionBlock * std::max<std::size_t>(every, 1);
  for (std::size_t first = 0; first < normals.size; first += step) {
    detail::load_directions(normals, first, block);
    const Lanes valid = block.x.square() + block.y.square() + block.z.square();
    std::array<Lanes, 3> part;
    Lanes sum = Lanes::Constant(kClutter);
    for (int k = 0; k < 3; ++k) {
      const Lanes along = axes(0, k) * block.x + axes(1, k) * block.y + axes(2, k) * block.z;
      Lanes& density = part[static_cast<std::size_t>(k)];
      density = (V(1) - (valid - along.square()) * inverse_cone).max(V(0)).square();
      density = peak * density.square();
      sum += density;
    }
    const Lanes votes_here = block.weight * valid;
    weight += static_cast<S>(votes_here.sum());
    count += static_cast<S>((votes_here > V(0)).count());
    const Lanes logs = sum.log();
    score += static_cast<S>((votes_here * logs).sum());
    if (gain == nullptr) continue;
    for (std::size_t k = 0; k < 3; ++k)
      lost[k] += static_cast<S>((votes_here * (logs - (sum - part[k] + kShare).log())).sum());
  }
  const S scale = weight > S(0) ? std::min(votes, count) / weight : S(0);
  if (gain != nullptr) {
    for (std::size_t k = 0; k < 3; ++k) (*gain)[k] = lost[k] * scale;
  }
  return score * scale;
}

// The score of the segments, with equal shares of axes and clutter, and `floor` (radians) added to each
// sigma.
template <Scalar S>
[[nodiscard]] S score_lines(std::span<const LineVote<S>> lines, const Mat3<S>& cam_from_axes,
                            S floor) noexcept {
  const LineShares<S> shares;
  S total = 0;
  for (const LineVote<S>& line : lines) {
    const detail::LineLikelihood<S> like(line, cam_from_axes, floor);
    total += std::log(shares.clutter() + shares.axis[0] * like.ratio.sum());
  }
  return total;
}

// The same for one direction alone: segments along it or clutter, over clutter.
template <Scalar S>
[[nodiscard]] S score_direction(std::span<const LineVote<S>> lines, const Vec3<S>& direction,
                                S floor) noexcept {
  constexpr S kShare = S(0.2);
  S total = 0;
  for (const LineVote<S>& line : lines) {
    const S residual = line.plane_normal.dot(direction);
    const S along = line.ray.dot(direction);
    total +=
        std::log(S(1) - kShare + kShare * detail::circle_ratio(line.sigma, residual, along, floor).ratio);
  }
  return total;
}

}  // namespace sslam
