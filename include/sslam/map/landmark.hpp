// SPDX-License-Identifier: BSD-3-Clause
// Landmarks: points and lines of the map, each with the keyframe features that observe it.
#pragma once

#include <cstdint>
#include <vector>

#include "sslam/core/descriptor.hpp"
#include "sslam/geometry/line3.hpp"

namespace sslam {

using KeyframeId = std::int32_t;
using LandmarkId = std::int32_t;
inline constexpr std::int32_t kNone = -1;

// The axis of its own Manhattan frame, 0, 1 or 2, that a number of Map::axis stands for; kNone for none.
[[nodiscard]] constexpr std::int8_t axis_in_frame(std::int8_t number) noexcept {
  return static_cast<std::int8_t>(number == kNone ? kNone : number % 3);
}

struct Observation {
  KeyframeId keyframe = kNone;
  std::int32_t feature = kNone;  // index into the keyframe's points or lines
};

// What points and lines have in common.
struct LandmarkCommon {
  Descriptor descriptor;  // of the most recent keyframe that observes it
  std::vector<Observation> observations;
  KeyframeId first_keyframe = kNone;  // that created it
  std::int32_t visible = 0;           // frames in which it should have been seen
  std::int32_t found = 0;             // frames in which it was
  bool alive = true;                  // false: culled or fused; a later landmark may take its id
};

template <Scalar S>
struct PointLandmark : LandmarkCommon {
  Vec3<S> position;           // world
  Vec3<S> viewing_direction;  // unit mean of the directions from the point to the cameras that see it
  S extent = 0;  // feature sigma times distance, metres at one pixel per radian: predicts the octave
};

template <Scalar S>
struct LineLandmark : LandmarkCommon {
  Line3<S> line;             // world
  Vec3<S> start, end;        // world, on the line: the part that has been seen
  std::int8_t axis = kNone;  // Manhattan axis that it follows, as Map::axis counts them, or kNone
};

}  // namespace sslam
