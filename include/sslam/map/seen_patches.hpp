// SPDX-License-Identifier: BSD-3-Clause
// Patches are most of what a frame weighs. Those of features that see no landmark are of no use, unless one
// is still to be made of them.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "sslam/map/frame.hpp"
#include "sslam/map/landmark.hpp"

namespace sslam {

// The frame's points, whose `patch` is a place in `all`, keep the patches of those that see a landmark.
template <Scalar S>
void keep_seen_patches(std::span<const FeaturePatch> all, std::span<const LandmarkId> seen, Frame<S>& frame) {
  std::vector<FeaturePatch> kept;
  for (std::size_t i = 0; i < frame.points.size(); ++i) {
    const auto patch = static_cast<std::size_t>(std::exchange(frame.points[i].patch, kNone));
    if (seen[i] == kNone || patch >= all.size()) continue;
    frame.points[i].patch = static_cast<std::int32_t>(kept.size());
    kept.push_back(all[patch]);
  }
  kept.shrink_to_fit();
  frame.patches = std::move(kept);
}

}  // namespace sslam
