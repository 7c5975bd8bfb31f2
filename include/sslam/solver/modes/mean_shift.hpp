// SPDX-License-Identifier: BSD-3-Clause
// Mean shift of unit directions on the tangent planes of orthogonal axes: one pass over a structure of
// arrays.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "sslam/core/types.hpp"

namespace sslam {

// Unit directions, one array per component; n and -n are the same vote. `weight` (>= 0) is the relative
// precision of each direction, null for all ones. Element i of each array stands at i * stride.
template <Scalar V>
struct DirectionView {
  const V* x = nullptr;
  const V* y = nullptr;
  const V* z = nullptr;
  const V* weight = nullptr;
  std::size_t size = 0;
  std::size_t stride = 1;
};

// Kernel k(q) = (1 - q / c^2)^4 inside the cone, 0 outside, of q = squared tangent-plane distance: the shape
// of a Gaussian with compact support and no exponential. As a density its variance per component is c^2 / 12,
// so the Gaussian it stands for has width h = c / sqrt(12), and a cone of 10 degrees means h = 2.9 degrees.
template <Scalar S>
[[nodiscard]] constexpr S squared_cone(S width) noexcept {
  return S(12) * width * width;
}

// What the votes near one axis add up to. Chart: gnomonic, (m_i, m_j) / m_k for a vote m in the frame of the
// axes, which needs no sign test for antipodes and agrees with the exponential chart at the fixed point.
template <Scalar S>
struct AxisMoments {
  S mass = 0;                      // sum of w k(q) m_k^2
  Vec2<S> mean = Vec2<S>::Zero();  // kernel-weighted mean of the votes: the mean-shift step, radians
  S variance = 0;                  // kernel-weighted variance per component about that mean, rad^2
};

template <Scalar S>
using FrameMoments = std::array<AxisMoments<S>, 3>;

namespace detail {

// Sizes are compile-time constants, so the loops below become packet arithmetic at -O2 without -march.
inline constexpr int kDirectionBlock = 128;
template <Scalar V>
using DirectionLanes = Eigen::Array<V, kDirectionBlock, 1>;

template <Scalar V>
struct DirectionBlock {
  DirectionLanes<V> x, y, z, weight;
};

// Directions [first, first + block), padded with zero vectors, which add nothing to any sum.
template <Scalar V>
void load_directions(const DirectionView<V>& view, std::size_t first, DirectionBlock<V>& block) noexcept {
  const auto count = std::min<std::size_t>(kDirectionBlock, view.size - first);
  if (count == kDirectionBlock && view.stride == 1) {
    using Map = Eigen::Map<const DirectionLanes<V>>;
    block.x = Map(view.x + first);
    block.y = Map(view.y + first);
    block.z = Map(view.z + first);
    if (view.weight != nullptr) block.weight = Map(view.weight + first);
    return;
  }
  block.x.setZero();
  block.y.setZero();
  block.z.setZero();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = (first + i) * view.stride;
    const auto lane = static_cast<Eigen::Index>(i);
    block.x[lane] = view.x[at];
    block.y[lane] = view.y[at];
    block.z[lane] = view.z[at];
    if (view.weight != nullptr) block.weight[lane] = view.weight[at];
  }
}

template <Scalar V, Scalar S>
void add_axis(const DirectionLanes<V>& along, const DirectionLanes<V>& i, const DirectionLanes<V>& j,
              const DirectionLanes<V>& weight, V inverse_squared_cone, AxisMoments<S>& sum) noexcept {
  const DirectionLanes<V> q = i * i + j * j;
  DirectionLanes<V> kernel = (V(1) - q * inverse_squared_cone).max(V(0));
  kernel = kernel.square();
  kernel = kernel.square() * weight;
  const DirectionLanes<V> pull = kernel * along;
  sum.mass += static_cast<S>((pull * along).sum());
  sum.mean.x() += static_cast<S>((pull * i).sum());
  sum.mean.y() += static_cast<S>((pull * j).sum());
  sum.variance += static_cast<S>((kernel * q).sum());
}

}  // namespace detail

// Moments of the votes around the three columns of `cam_from_axes` (orthonormal), for a kernel of the given
// width (radians). mean and the tangent coordinates of axis k run along axes (k+1)%3 and (k+2)%3. With
// every > 1 only one block of directions in `every` is read. O(size), no heap.
template <Scalar S, Scalar V>
[[nodiscard]] FrameMoments<S> frame_moments(const DirectionView<V>& votes, const Mat3<S>& cam_from_axes,
                                            S width, std::size_t every = 1) noexcept {
  FrameMoments<S> sums{};
  const Mat3<V> a = cam_from_axes.template cast<V>();
  const V inverse_squared_cone = V(1) / static_cast<V>(squared_cone(width));
  detail::DirectionBlock<V> block;
  block.weight.setOnes();
  const std::size_t step = detail::kDirectionBlock * std::max<std::size_t>(every, 1);
  for (std::size_t first = 0; first < votes.size; first += step) {
    detail::load_directions(votes, first, block);
    const detail::DirectionLanes<V> m0 = a(0, 0) * block.x + a(1, 0) * block.y + a(2, 0) * block.z;
    const detail::DirectionLanes<V> m1 = a(0, 1) * block.x + a(1, 1) * block.y + a(2, 1) * block.z;
    const detail::DirectionLanes<V> m2 = a(0, 2) * block.x + a(1, 2) * block.y + a(2, 2) * block.z;
    detail::add_axis(m0, m1, m2, block.weight, inverse_squared_cone, sums[0]);
    detail::add_axis(m1, m2, m0, block.weight, inverse_squared_cone, sums[1]);
    detail::add_axis(m2, m0, m1, block.weight, inverse_squared_cone, sums[2]);
  }
  for (AxisMoments<S>& axis : sums) {
    if (!(axis.mass > S(0))) continue;
    axis.mean /= axis.mass;
    axis.variance = std::max(S(0), S(0.5) * (axis.variance / axis.mass - axis.mean.squaredNorm()));
  }
  return sums;
}

// Sum of w |n|^2: the total weight of unit directions, where zero vectors count as nothing. NaN or infinite
// as soon as one input is, and infinite where one is longer than 2: not a direction.
template <Scalar S, Scalar V>
[[nodiscard]] S total_weight(const DirectionView<V>& votes, std::size_t every = 1) noexcept {
  S total = 0;
  detail::DirectionLanes<V> longest = detail::DirectionLanes<V>::Zero();
  detail::DirectionBlock<V> block;
  block.weight.setOnes();
  const std::size_t step = detail::kDirectionBlock * std::max<std::size_t>(every, 1);
  for (std::size_t first = 0; first < votes.size; first += step) {
    detail::load_directions(votes, first, block);
    const detail::DirectionLanes<V> squared = block.x.square() + block.y.square() + block.z.square();
    longest = longest.max(squared);
    total += static_cast<S>((block.weight * squared).sum());
  }
  return longest.maxCoeff() > V(4) ? std::numeric_limits<S>::infinity() : total;
}

// The variance s^2 per component of votes whose kernel-weighted variance is v: under a Gaussian of width h,
// v = s^2 h^2 / (s^2 + h^2), so flat clutter (v = h^2) answers with an unbounded spread. The factor
// (s^2 + h^2) / h^2 = h^2 / (h^2 - v) is also what a mean-shift step falls short of the mode by, and what the
// kernel hides of the mass.
template <Scalar S>
[[nodiscard]] constexpr S kernel_gain(S variance, S width) noexcept {
  const S h2 = width * width;
  constexpr S kMost = S(20);
  return variance < h2 * (S(1) - S(1) / kMost) ? h2 / (h2 - variance) : kMost;
}

}  // namespace sslam
