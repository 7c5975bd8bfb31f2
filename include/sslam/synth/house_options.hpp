// SPDX-License-Identifier: BSD-3-Clause
// What a synthetic house is drawn from, and what it is.
#pragma once

#include <cstdint>

#include "sslam/synth/decor.hpp"
#include "sslam/synth/light_baker.hpp"
#include "sslam/synth/outline.hpp"
#include "sslam/synth/path.hpp"
#include "sslam/synth/scene.hpp"

namespace sslam::synth {

enum class World : std::uint8_t {
  kManhattan,  // every edge along one of three axes
  kTurned,     // Manhattan walls, furniture turned about the vertical
  kOblique,    // one wall cuts a corner at an angle that is neither 0 nor 90 degrees
  kFree,       // vertical walls of which no two are at right angles
};

enum class PathKind : std::uint8_t { kLoop, kSweep, kPivot };

inline constexpr int kMostRooms = 50;

struct HouseOptions {
  std::uint64_t seed = 1;
  Richness richness = Richness::kRich;
  World world = World::kManhattan;
  PathKind path = PathKind::kLoop;  // of a single room; several have a tour
  int rooms = 1;                    // up to kMostRooms; the worlds of several are kManhattan and kTurned
  float texel = 0.003f;             // metres per texel on walls
  PathOptions motion = {};
  LightingOptions lighting = {};
  bool lit = true;          // false: for who does not render, faces have no light
  double off_square = 0.0;  // degrees, standard deviation of walls and furniture; of a kManhattan room
  bool doors_ajar = false;  // of one room or three
  int clutter = 0;          // small things, of one room or three
};

struct House {
  Scene scene;
  ClosedPath path;
  Outline outline = {};  // of a single room; wall i runs from corner i to the next
};

}  // namespace sslam::synth
