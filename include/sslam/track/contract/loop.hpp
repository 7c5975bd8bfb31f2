// SPDX-License-Identifier: BSD-3-Clause
// A loop: a keyframe shows a place of its map, or of another map, that it shares no landmarks with.
#pragma once

#include <cstdint>
#include <vector>

#include "sslam/geometry/sim3.hpp"
#include "sslam/map/landmark.hpp"

namespace sslam {

template <Scalar S>
struct Loop {
  KeyframeId place = kNone;  // the keyframe that shows the same place
  Sim3<S> cam_from_world;    // of the keyframe that closes the loop, in the world around `place`
  // For each feature of the keyframe, its landmark at the place, or kNone.
  std::vector<LandmarkId> point_landmarks;
  std::vector<LandmarkId> line_landmarks;
  int matches = 0;

  // From the keyframe's world to that of the place.
  [[nodiscard]] Sim3<S> there_from_here(const SE3<S>& cam_from_here) const {
    return cam_from_world.inverse() * similarity(cam_from_here);
  }
};

// What must speak for a loop that is closed on trial, after the last frame.
enum class TrialEvidence : std::uint8_t {
  kBeside,       // what both sides share beside that by which the place was recognised
  kLikelyDrift,  // several keyframes that recognise it, and a drift that the way since then explains
};

}  // namespace sslam
