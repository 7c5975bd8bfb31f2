// SPDX-License-Identifier: BSD-3-Clause
// What the loop stage answers: how the world moved, and how one map became part of another.
#pragma once

#include <cstddef>
#include <span>

#include "sslam/geometry/sim3.hpp"
#include "sslam/map/landmark.hpp"

namespace sslam {

template <Scalar S>
struct LoopAnswer {
  bool closed = false;
  // By keyframe, how the world moved there; empty where nothing had drifted. Valid until the next call.
  std::span<const Sim3<S>> new_from_old;

  // What lengths at the keyframe are multiplied by.
  [[nodiscard]] S scale_at(KeyframeId keyframe) const {
    return new_from_old.empty() ? S(1) : new_from_old[static_cast<std::size_t>(keyframe)].scale;
  }
};

// What is added to the ids of the map that moves.
struct IdShift {
  std::int32_t keyframes = 0, points = 0, lines = 0, planes = 0;

  static void apply(std::int32_t& id, std::int32_t shift) noexcept {
    if (id != kNone) id += shift;
  }
  // Of a frame or a keyframe.
  template <class View>
  void apply_to_matches(View& view) const {
    for (LandmarkId& id : view.point_landmarks) apply(id, points);
    for (LandmarkId& id : view.line_landmarks) apply(id, lines);
  }
};

// How one map has become part of another.
template <Scalar S>
struct MapJoint {
  Sim3<S> moved;  // its world, in the other
  IdShift shift;
};

}  // namespace sslam
