// SPDX-License-Identifier: BSD-3-Clause
// The gauge of a bundle in which a single view is held: its scale is open.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sslam/solver/bundle/bundle_graph.hpp"

namespace sslam {

// The distance between the view `held` and the free one that is farthest from it keeps its length; nothing is
// tied where no view is free, or all are in one place.
template <Scalar S>
void tie_scale(BundleGraph<S>& graph, std::size_t held) {
  const Vec3<S> centre = graph.views[held].cam_from_world.inverse().translation;
  ScaleTie<S> tie{static_cast<std::int32_t>(held), -1, 0};
  for (std::size_t v = 0; v < graph.views.size(); ++v) {
    if (graph.views[v].hold != Hold::kNothing) continue;
    const S distance = (graph.views[v].cam_from_world.inverse().translation - centre).norm();
    if (distance > tie.distance) tie = {tie.held, static_cast<std::int32_t>(v), distance};
  }
  if (tie.free >= 0) graph.scale = tie;
}

}  // namespace sslam
