// SPDX-License-Identifier: BSD-3-Clause
// The result of the pipeline for one frame: its pose and how it was found, or the reason why it has none.
#pragma once

#include <cstdint>

#include "sslam/geometry/se3.hpp"

namespace sslam {

enum class State : std::uint8_t {
  kInitialising,  // no map yet
  kManhattan,     // rotation from the Manhattan frame, translation from points and lines
  kFallback,      // full pose from points and lines
  kUncertain,     // a pose too uncertain to build the map on
  kLost,          // no pose
};

enum class Reason : std::uint8_t {
  kFine,               // no reason
  kTooFewFeatures,     // the image shows too little
  kTooFewMatches,      // too few features of the reference frame, or of the map, are matched
  kLowParallax,        // the camera has only turned or stood still: no depth yet
  kNoConsensus,        // the matches do not agree on one motion
  kNoManhattanFrame,   // no Manhattan evidence in this image
  kManhattanRejected,  // the Manhattan pose disagrees with the map
  kUncertainPose,      // enough matches, but the pose is too uncertain
  kRelocalised,        // found again after a loss
};

[[nodiscard]] constexpr const char* name(State state) noexcept {
  switch (state) {
    case State::kInitialising:
      return "initialising";
    case State::kManhattan:
      return "manhattan";
    case State::kFallback:
      return "fallback";
    case State::kUncertain:
      return "uncertain";
    case State::kLost:
      return "lost";
  }
  return "unknown";
}

[[nodiscard]] constexpr const char* name(Reason reason) noexcept {
  switch (reason) {
    case Reason::kFine:
      return "";
    case Reason::kTooFewFeatures:
      return "too few features";
    case Reason::kTooFewMatches:
      return "too few matches";
    case Reason::kLowParallax:
      return "low parallax";
    case Reason::kNoConsensus:
      return "no consensus";
    case Reason::kNoManhattanFrame:
      return "no Manhattan evidence";
    case Reason::kManhattanRejected:
      return "Manhattan pose rejected";
    case Reason::kUncertainPose:
      return "uncertain pose";
    case Reason::kRelocalised:
      return "relocalised";
  }
  return "unknown";
}

template <Scalar S>
struct TrackResult {
  std::int64_t index = -1;  // position in the dataset
  double stamp = 0;         // seconds
  State state = State::kInitialising;
  Reason reason = Reason::kFine;
  SE3<S> cam_from_world;  // valid if has_pose()
  // Of xi = (phi, rho) in exp(xi) * cam_from_world, in the camera's axes: rotation first, rad^2, then
  // position, units of the map squared. The map counts as exact: its drift is not included. Valid if
  // has_covariance().
  Mat6<S> covariance = Mat6<S>::Zero();
  int world = 0;  // number of the map that the pose is in; each new map has its own until maps are joined
  int point_inliers = 0;
  int line_inliers = 0;
  int axes_seen = 0;         // Manhattan axes with support: 3, 2, 1 or 0
  bool structure = false;    // the Manhattan rotation took part in the pose, and the pose agrees with it
  int image_fixed = 0;       // number of features left out because they never move in the image
  bool keyframe = false;     // the frame became a keyframe
  bool loop_closed = false;  // by a place that this frame shows; live: since the last frame
  bool maps_joined = false;  // by a place of a map that had been left

  [[nodiscard]] bool has_pose() const noexcept {
    return state == State::kManhattan || state == State::kFallback || state == State::kUncertain;
  }
  // Whether the pose was refined against the map. Not so for a frame that begins a map, and with
  // NoRefinement.
  [[nodiscard]] bool has_covariance() const noexcept { return covariance(0, 0) > 0; }
};

}  // namespace sslam
