// SPDX-License-Identifier: BSD-3-Clause
// Input of the rotation stage from the world, and its result for one frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sslam/map/keyframe.hpp"

namespace sslam {

// The known axes of the world, before the frame is processed.
template <Scalar S>
struct KnownAxes {
  const std::vector<SO3<S>>& world_from_manhattan;  // the Manhattan frames of the world
  bool world_fixed = false;  // false: there is no map yet, and the first Manhattan frame defines the world
};

// Unit directions in the camera frame, one for each axis of a Manhattan frame; empty for axes that were not
// seen.
template <Scalar S>
using NormalAxes = std::array<std::optional<Vec3<S>>, 3>;

template <Scalar S>
struct RotationAnswer {
  struct Seen {
    RotationObservation<S> rotation;
    bool certain = false;             // known in all three degrees of freedom, so it may be held fixed
    std::size_t manhattan_frame = 0;  // the one it comes from, in KnownAxes::world_from_manhattan
  };

  std::optional<Seen> seen = {};  // empty: the frame does not show its rotation
  int axes_seen = 0;              // Manhattan axes with support
  // For each line its axis 0, 1 or 2 of that Manhattan frame, or kNone; empty if none is known. Valid until
  // the next call.
  std::span<const std::int8_t> line_axes = {};
  // world_from_manhattan of a new Manhattan frame, to be appended to the known ones.
  std::optional<SO3<S>> discovered = {};
  NormalAxes<S> normal_axes = {};  // the axes of that Manhattan frame as seen by the normals alone

  [[nodiscard]] bool trusted() const noexcept { return seen && seen->certain; }
};

}  // namespace sslam
