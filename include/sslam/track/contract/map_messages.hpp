// SPDX-License-Identifier: BSD-3-Clause
// What a tracker and a map that is kept elsewhere tell each other: keyframes one way, snapshots of the map
// the other. Neither ever looks at what the other one holds.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sslam/map/map.hpp"
#include "sslam/track/contract/tracked_frame.hpp"

namespace sslam {

// How often a landmark should have been seen, and was, since that was last told.
struct Sightings {
  LandmarkId landmark = kNone;
  std::int32_t visible = 0, found = 0;
};

// A tracked frame for the map. Its place is told from its reference keyframe, since the map has moved on.
template <Scalar S>
struct KeyframePost {
  TrackedFrame<S> frame;  // without its normals, and its pose is the tracker's
  KeyframeId reference = kNone;
  SE3<S> frame_from_reference;
  S median_depth = 0;
  S scale = 1;            // of the tracker's lengths there, as MapSnapshot::scales has it
  std::size_t known = 0;  // keyframes of the snapshot that the tracker's landmark ids are from
  std::vector<SO3<S>> world_from_manhattan;
  std::vector<Sightings> points, lines;
};

// The map as of the newest keyframe in it.
template <Scalar S>
struct MapSnapshot {
  Map<S> map;
  std::vector<S>
      scales;     // by keyframe: what loops have multiplied its lengths by since the map was handed over
  int loops = 0;  // closed since then
  int given = 0;  // to the server when the map was: its first, its second, ...; 0: not from there
};

// Whether an id still means what it meant in a map of `known` keyframes. A free id is given away by a new
// keyframe alone, which is then the landmark's first.
template <class Landmarks>
[[nodiscard]] bool still_means(const Landmarks& landmarks, LandmarkId id, std::size_t known) {
  const auto& landmark = landmarks[static_cast<std::size_t>(id)];
  return landmark.alive && landmark.first_keyframe < static_cast<KeyframeId>(known);
}

// Takes away the matches with landmarks that are gone.
template <class Landmarks>
void forget_gone(std::vector<LandmarkId>& seen, const Landmarks& landmarks, std::size_t known) {
  std::replace_if(
      seen.begin(), seen.end(),
      [&](LandmarkId id) { return id != kNone && !still_means(landmarks, id, known); }, kNone);
}

}  // namespace sslam
