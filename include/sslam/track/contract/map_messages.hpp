// SPDX-License-Identifier: BSD-3-Clause
// Messages between a tracker and a map that is kept elsewhere: keyframes in one direction, snapshots of the
// map in the other. They share no state.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sslam/map/map.hpp"
#include "sslam/track/contract/tracked_frame.hpp"

namespace sslam {

// How often a landmark should have been seen, and was seen, since the last message.
struct Sightings {
  LandmarkId landmark = kNone;
  std::int32_t visible = 0, found = 0;
};

// A tracked frame for the map. Its pose is relative to its reference keyframe, since the map may have
// changed.
template <Scalar S>
struct KeyframePost {
  TrackedFrame<S> frame;  // without its normals, with the tracker's pose
  KeyframeId reference = kNone;
  SE3<S> frame_from_reference;
  S median_depth = 0;
  S scale = 1;            // of the tracker's lengths at the reference, as in MapSnapshot::scales
  std::size_t known = 0;  // keyframes of the snapshot that the tracker's landmark ids are from
  std::vector<SO3<S>> world_from_manhattan;
  std::vector<Sightings> points, lines;
};

// The map after its newest keyframe.
template <Scalar S>
struct MapSnapshot {
  Map<S> map;
  std::vector<S>
      scales;     // by keyframe: what loops have multiplied its lengths by since the map was handed over
  int loops = 0;  // loops closed since then
  int given = 0;  // which handover of a map to the server this follows, from 1; 0: not from the server
};

// Whether an id still means the same landmark as in a map of `known` keyframes. Only a new keyframe reuses a
// free id, and it is then the landmark's first keyframe.
template <class Landmarks>
[[nodiscard]] bool still_means(const Landmarks& landmarks, LandmarkId id, std::size_t known) {
  const auto& landmark = landmarks[static_cast<std::size_t>(id)];
  return landmark.alive && landmark.first_keyframe < static_cast<KeyframeId>(known);
}

// Removes the matches with erased landmarks.
template <class Landmarks>
void forget_gone(std::vector<LandmarkId>& seen, const Landmarks& landmarks, std::size_t known) {
  std::replace_if(
      seen.begin(), seen.end(),
      [&](LandmarkId id) { return id != kNone && !still_means(landmarks, id, known); }, kNone);
}

}  // namespace sslam
