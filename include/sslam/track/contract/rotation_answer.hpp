// SPDX-License-Identifier: BSD-3-Clause
// What the rotation stage is told of the world, and what it answers for one frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sslam/map/keyframe.hpp"

namespace sslam {

// What the map knows of its world's axes before the frame is looked at.
template <Scalar S>
struct KnownAxes {
  const std::vector<SO3<S>>& world_from_manhattan;  // the Manhattan frames of the world
  bool world_fixed = false;  // false: there is no map yet, and the first Manhattan frame becomes its world
};

// Unit directions in the camera frame, one for each axis of a Manhattan frame; empty where none was seen.
template <Scalar S>
using NormalAxes = std::array<std::optional<Vec3<S>>, 3>;

template <Scalar S>
struct RotationAnswer {
  struct Seen {
    RotationObservation<S> rotation;
    bool certain = false;             // in all three degrees of freedom: it may be held fixed
    std::size_t manhattan_frame = 0;  // of the world's, that it comes from
  };

  std::optional<Seen> seen = {};  // empty: this frame shows nothing of its rotation
  int axes_seen = 0;              // Manhattan axes with support
  // Axis 0, 1 or 2 of that Manhattan frame for each line, or kNone; empty where none is known. Valid until
  // the stage is called again.
  std::span<const std::int8_t> line_axes = {};
  // How a new Manhattan frame stands in the world, which is to join those that are known, as their last.
  std::optional<SO3<S>> discovered = {};
  NormalAxes<S> normal_axes = {};  // where the frame's normals, by themselves, see the axes of that frame

  [[nodiscard]] bool trusted() const noexcept { return seen && seen->certain; }
};

}  // namespace sslam
