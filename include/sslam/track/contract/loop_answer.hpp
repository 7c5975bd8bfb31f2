// SPDX-License-Identifier: BSD-3-Clause
// Results of the loop stage: how the world moved, and how one map became part of another.
#pragma once

#include <cstddef>
#include <span>

#include "sslam/geometry/sim3.hpp"
#include "sslam/map/id_shift.hpp"

namespace sslam {

template <Scalar S>
struct LoopAnswer {
  bool closed = false;
  // For each keyframe, how the world moved there; empty if nothing had drifted. Valid until the next call.
  std::span<const Sim3<S>> new_from_old;

  // Factor of lengths at the keyframe.
  [[nodiscard]] S scale_at(KeyframeId keyframe) const {
    return new_from_old.empty() ? S(1) : new_from_old[static_cast<std::size_t>(keyframe)].scale;
  }
};

// How one map became part of another.
template <Scalar S>
struct MapJoint {
  Sim3<S> moved;  // from its world to that of the other map
  IdShift shift;
};

}  // namespace sslam
