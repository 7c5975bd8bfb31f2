// SPDX-License-Identifier: BSD-3-Clause
// What a synthetic house is drawn from.
#pragma once

#include <cstdint>

#include "sslam/synth/decor.hpp"
#include "sslam/synth/light_baker.hpp"
#include "sslam/synth/path.hpp"

namespace sslam::synth {

enum class World : std::uint8_t {
  kManhattan,  // every edge along one of three axes
  kTurned,     // Manhattan walls, furniture turned about the vertical
  kOblique,    // one wall cuts a corner at an angle that is neither 0 nor 90 degrees
  kFree,       // vertical walls of which no two are at right angles
};

enum class PathKind : std::uint8_t { kLoop, kSweep, kPivot };

struct HouseOptions {
  std::uint64_t seed = 1;
  Richness richness = Richness::kRich;
  World world = World::kManhattan;
  PathKind path = PathKind::kLoop;  // of a single room; three rooms have a tour
  int rooms = 1;                    // 1 or 3
  float texel = 0.003f;             // metres per texel on walls
  PathOptions motion = {};
  LightingOptions lighting = {};
};

}  // namespace sslam::synth
