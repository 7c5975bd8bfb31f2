// SPDX-License-Identifier: BSD-3-Clause
// Finds a Manhattan frame among those of a world.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sslam/manhattan/cube.hpp"

namespace sslam {

// The Manhattan frame closest to this orientation in the world, if it is within max_turn, radians.
template <Scalar S>
[[nodiscard]] std::optional<std::size_t> nearest_frame(const std::vector<SO3<S>>& world_from_manhattan,
                                                       const SO3<S>& wanted, S max_turn) {
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < world_from_manhattan.size(); ++i) {
    const S turn = angle_between_frames(wanted, world_from_manhattan[i]);
    if (!(turn < max_turn)) continue;
    max_turn = turn;
    nearest = i;
  }
  return nearest;
}

}  // namespace sslam
