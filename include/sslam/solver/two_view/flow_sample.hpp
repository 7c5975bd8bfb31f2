// SPDX-License-Identifier: BSD-3-Clause
// A bounded sample of the flows of two views, the gate that tells which of them agree with a direction of
// translation, and what they say about depth.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "sslam/core/median.hpp"
#include "sslam/solver/two_view/flow.hpp"
#include "sslam/solver/two_view/stratified_sample.hpp"

namespace sslam {

// At most kCapacity matches, spread evenly over the list, so that time and stack do not grow with it.
template <Scalar S>
struct FlowSample {
  static constexpr int kCapacity = 256;
  std::array<Flow<S>, kCapacity> flows;
  std::array<std::uint16_t, kCapacity>
      moved;  // the flows longer than min_parallax: only these tell a direction
  int size = 0;
  int moved_count = 0;

  FlowSample(std::span<const BearingMatch<S>> matches, const Mat3<S>& R_10, S rotation_sigma, S min_parallax,
             Random& random) noexcept {
    const std::size_t slots = std::min(matches.size(), std::size_t{kCapacity});
    for (std::size_t slot = 0; slot < slots; ++slot) {
      const std::size_t i = stratified_index(slot, slots, matches.size(), random);
      Flow<S>& flow = flows[static_cast<std::size_t>(size)];
      if (!compensate(R_10, matches[i], rotation_sigma, flow)) continue;
      if (flow.weight * flow.squared_length() > min_parallax * min_parallax)
        moved[static_cast<std::size_t>(moved_count++)] = static_cast<std::uint16_t>(size);
      ++size;
    }
  }

  [[nodiscard]] std::span<const Flow<S>> view() const noexcept {
    return {flows.data(), static_cast<std::size_t>(size)};
  }
  [[nodiscard]] const Flow<S>& moved_flow(int i) const noexcept {
    return flows[moved[static_cast<std::size_t>(i)]];
  }
};

// Which flows agree with a direction.
template <Scalar S>
struct FlowGate {
  S max_error = 3;                            // standard deviations from the epipolar half-line
  S nearest = std::numeric_limits<S>::max();  // largest inverse depth, in baselines

  [[nodiscard]] bool accepts(const EpipolarFit<S>& fit) const noexcept {
    const S behind = std::min(fit.along, S(0));
    return fit.across * fit.across + behind * behind < max_error * max_error &&
           fit.along - max_error < nearest * fit.unit;
  }
  [[nodiscard]] bool accepts(const Flow<S>& flow, const Vec3<S>& t_10) const noexcept {
    return accepts(epipolar_fit(flow, t_10));
  }
};

// Both over the flows of the sample that the gate accepts.
template <Scalar S>
struct ParallaxMedians {
  S angle = 0;                                 // between R_10 x0 and x1, rad
  S nearness = std::numeric_limits<S>::max();  // inverse depth of the moved ones, in baselines
};

template <Scalar S>
[[nodiscard]] ParallaxMedians<S> parallax_medians(const FlowSample<S>& sample, const FlowGate<S>& gate,
                                                  const Vec3<S>& t_10) noexcept {
  std::array<S, FlowSample<S>::kCapacity> angles, nearness;
  std::size_t accepted = 0, moved = 0;
  for (const Flow<S>& flow : sample.view()) {
    const EpipolarFit<S> fit = epipolar_fit(flow, t_10);
    if (!gate.accepts(fit)) continue;
    const S cosine = 1 + flow.midpoint.squaredNorm() - flow.squared_length() / 4;
    angles[accepted++] = std::atan2(flow.normal.norm(), cosine);
    if (fit.along > gate.max_error) nearness[moved++] = fit.along / fit.unit;
  }
  ParallaxMedians<S> medians;
  if (accepted > 0) medians.angle = median(std::span<S>(angles.data(), accepted));
  if (moved > 0) medians.nearness = median(std::span<S>(nearness.data(), moved));
  return medians;
}

}  // namespace sslam
