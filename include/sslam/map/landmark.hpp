// SPDX-License-Identifier: BSD-3-Clause
// Landmarks: points and lines of the map, each with the keyframe features that observe it, and the planes
// that they lie on.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "sslam/core/descriptor.hpp"
#include "sslam/geometry/line3.hpp"
#include "sslam/geometry/plane3.hpp"
#include "sslam/map/map_list.hpp"

namespace sslam {

using KeyframeId = std::int32_t;
using LandmarkId = std::int32_t;
inline constexpr std::int32_t kNone = -1;

// How many features of a list have a landmark.
[[nodiscard]] inline int count_held(const std::vector<LandmarkId>& landmarks) {
  return static_cast<int>(landmarks.size()) -
         static_cast<int>(std::count(landmarks.begin(), landmarks.end(), kNone));
}

struct Observation {
  KeyframeId keyframe = kNone;
  std::int32_t feature = kNone;  // index into the keyframe's points or lines
};

// What points and lines have in common.
struct LandmarkCommon {
  Descriptor descriptor;  // of the most recent keyframe that observes it
  MapList<Observation> observations;
  KeyframeId first_keyframe = kNone;  // that created it
  std::int32_t visible = 0;           // frames in which it should have been seen
  std::int32_t found = 0;             // frames in which it was
  LandmarkId plane = kNone;           // that it lies on
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
  std::int8_t axis = kNone;  // Manhattan axis that it follows, by its number (manhattan_axes.hpp), or kNone
};

// Its members say where it is: points and lines whose `plane` it is. No feature observes it.
template <Scalar S>
struct PlaneLandmark {
  Plane3<S> plane;           // world
  std::int8_t axis = kNone;  // number of the Manhattan axis that it is normal to, or kNone
  std::int32_t support = 0;  // members when they were last counted
  bool alive = true;         // false: a later plane may take its id
};

}  // namespace sslam
