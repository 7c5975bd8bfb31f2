// SPDX-License-Identifier: BSD-3-Clause
// The outline of a room, and the walls along it with the places of their openings. A wall's Placement has x
// along the wall, y into the room.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "sslam/synth/scene.hpp"

namespace sslam::synth {

using Outline = std::vector<Vec2<double>>;  // corners, counterclockwise seen from above

struct Opening {
  enum Kind { kPassage, kDoor, kWindow } kind;
  double left, right, bottom, top;  // metres along x and z
  double depth = 0.12;              // of the reveal; 0 where the wall behind has it
};

struct Wall {
  Placement place;
  double length, height;
  std::vector<Opening> openings = {};  // from left to right, not overlapping
};

[[nodiscard]] inline Wall wall_between(const Vec2<double>& from, const Vec2<double>& to, double height) {
  const Vec2<double> run = to - from;
  return {{from, std::atan2(run.y(), run.x())}, run.norm(), height};
}

// Wall i runs from corner i to the next.
[[nodiscard]] inline std::vector<Wall> walls_around(const Outline& corners, double height) {
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    walls.push_back(wall_between(corners[i], corners[(i + 1) % corners.size()], height));
  }
  return walls;
}

[[nodiscard]] inline Outline rectangle(const Vec2<double>& low, const Vec2<double>& high) {
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

}  // namespace sslam::synth
