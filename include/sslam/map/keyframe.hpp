// SPDX-License-Identifier: BSD-3-Clause
// A frame that stays in the map: its features, which landmark each of them sees, and its neighbours.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "sslam/geometry/se3.hpp"
#include "sslam/map/frame.hpp"
#include "sslam/map/landmark.hpp"
#include "sslam/map/seen_patches.hpp"

namespace sslam {

// The rotation that Manhattan structure alone gives a frame.
template <Scalar S>
struct RotationObservation {
  SO3<S> cam_from_world;
  Mat3<S> covariance = Mat3<S>::Zero();  // of the left perturbation, rad^2
};

struct Neighbour {
  KeyframeId keyframe = kNone;
  std::int32_t shared = 0;  // landmarks seen by both
};

template <Scalar S>
struct Keyframe {
  KeyframeId id = kNone;
  Frame<S> frame;
  SE3<S> cam_from_world;
  MapList<LandmarkId> point_landmarks;  // one for each frame.points, kNone where there is none
  MapList<LandmarkId> line_landmarks;   // one for each frame.lines
  std::vector<std::int8_t> line_axes;   // number of each line's Manhattan axis, or kNone
  std::optional<RotationObservation<S>> manhattan;
  std::vector<Neighbour> neighbours;  // covisibility, most shared first
  // Of a keyframe that was removed as redundant: its parent in the spanning tree, relative to which its pose
  // is kept. Nothing else is left of it.
  KeyframeId parent = kNone;
  SE3<S> cam_from_parent;

  [[nodiscard]] bool alive() const noexcept { return parent == kNone; }

  // Whether it is what this frame became. Where features are may differ since then.
  [[nodiscard]] bool made_of(const Frame<S>& seen) const noexcept { return frame.index == seen.index; }

  void drop_unseen_patches() {
    keep_seen_patches<S>(std::exchange(frame.patches, {}), point_landmarks.values(), frame);
  }

  // Becomes what it is in a later state of its map. Features go as a whole or stay as they are: those that
  // are here already are not copied.
  void renew_from(const Keyframe& later) {
    const bool has_features = made_of(later.frame) && frame.stamp == later.frame.stamp &&
                              frame.points.size() == later.frame.points.size() &&
                              frame.lines.size() == later.frame.lines.size();
    if (!has_features) frame = later.frame;
    id = later.id;
    cam_from_world = later.cam_from_world;
    point_landmarks = later.point_landmarks;
    line_landmarks = later.line_landmarks;
    line_axes = later.line_axes;
    manhattan = later.manhattan;
    neighbours = later.neighbours;
    parent = later.parent;
    cam_from_parent = later.cam_from_parent;
  }

  // The same, which is yet to join a map and sees these landmarks of it.
  [[nodiscard]] Keyframe seeing(std::vector<LandmarkId> points, std::vector<LandmarkId> lines) && {
    point_landmarks.values_ = std::move(points);
    line_landmarks.values_ = std::move(lines);
    return std::move(*this);
  }
};

}  // namespace sslam
