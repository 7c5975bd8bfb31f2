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

  [[nodiscard]] bool seen_by(KeyframeId keyframe) const {
    return std::any_of(observations.begin(), observations.end(),
                       [&](const Observation& o) { return o.keyframe == keyframe; });
  }
};

template <Scalar S>
struct PointLandmark : LandmarkCommon {
  Vec3<S> position;           // world
  Vec3<S> viewing_direction;  // unit mean of the directions from the point to the cameras that see it
  S extent = 0;  // feature sigma times distance, metres at one pixel per radian: predicts the octave

  // `centre` (world) is where the camera of its newest observation was, and `sigma` that of the feature.
  void take_view(const Vec3<S>& centre, S sigma) {
    const Vec3<S> to_camera = centre - position;
    const S distance = to_camera.norm();
    extent = sigma * distance;
    const auto n = static_cast<S>(observations.size());
    const Vec3<S> mean = viewing_direction * (n - 1) + to_camera / std::max(distance, S(1e-9));
    viewing_direction = mean.normalized();
  }
};

template <Scalar S>
struct LineLandmark : LandmarkCommon {
  Line3<S> line;             // world
  Vec3<S> start, end;        // world, on the line: the part that has been seen
  std::int8_t axis = kNone;  // Manhattan axis that it follows, by its number (manhattan_axes.hpp), or kNone
};

// As the keyframe `creator` makes it, before anything observes it. `position`: world.
template <Scalar S>
[[nodiscard]] PointLandmark<S> new_point_landmark(const Vec3<S>& position, KeyframeId creator) {
  PointLandmark<S> point;
  point.position = position;
  point.viewing_direction.setZero();
  point.first_keyframe = creator;
  point.visible = point.found = 1;
  return point;
}

// The same; `start` and `end` lie on `line`, all in the world.
template <Scalar S>
[[nodiscard]] LineLandmark<S> new_line_landmark(const Line3<S>& line, const Vec3<S>& start,
                                                const Vec3<S>& end, KeyframeId creator) {
  LineLandmark<S> landmark;
  landmark.line = line;
  landmark.start = start;
  landmark.end = end;
  landmark.first_keyframe = creator;
  landmark.visible = landmark.found = 1;
  return landmark;
}

// Its members say where it is: points and lines whose `plane` it is. No feature observes it.
template <Scalar S>
struct PlaneLandmark {
  Plane3<S> plane;           // world
  std::int8_t axis = kNone;  // number of the Manhattan axis that it is normal to, or kNone
  std::int32_t support = 0;  // members when they were last counted
  bool alive = true;         // false: a later plane may take its id
};

}  // namespace sslam
