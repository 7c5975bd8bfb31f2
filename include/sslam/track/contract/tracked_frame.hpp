// SPDX-License-Identifier: BSD-3-Clause
// A frame in the tracker: features, an index over them, their landmarks, and a pose.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "sslam/map/feature_grid.hpp"
#include "sslam/map/keyframe.hpp"
#include "sslam/map/manhattan_axes.hpp"
#include "sslam/track/contract/rotation_answer.hpp"

namespace sslam {

template <Scalar S>
struct TrackedFrame {
  Frame<S> frame;
  FeatureGrid<S> grid;                      // over frame.points
  std::vector<LandmarkId> point_landmarks;  // one for each of frame.points; kNone: no match
  std::vector<LandmarkId> line_landmarks;   // one for each of frame.lines
  std::vector<std::int8_t> line_axes;       // number of each line's Manhattan axis, or kNone
  std::optional<RotationObservation<S>> manhattan;
  std::size_t manhattan_frame = 0;  // the one of the map that this rotation comes from
  SE3<S> cam_from_world;

  // Takes the features by swapping, so that both sides keep their buffers.
  void adopt(Frame<S>& source) {
    std::swap(frame, source);
    grid.build(frame.points, frame.width, frame.height);
    forget_manhattan();
    forget_matches();
  }

  // Takes the result of the rotation stage; converts the lines' axes to their numbers in the world.
  void take(const RotationAnswer<S>& answer, const std::vector<SO3<S>>& world_from_manhattan) {
    forget_manhattan();
    if (!answer.seen) return;
    manhattan = answer.seen->rotation;
    manhattan_frame = answer.seen->manhattan_frame;
    if (manhattan_frame >= world_from_manhattan.size()) return;  // the rotation comes from elsewhere
    const std::size_t lines = std::min(answer.line_axes.size(), line_axes.size());
    for (std::size_t i = 0; i < lines; ++i)
      line_axes[i] = axis_number(world_from_manhattan, manhattan_frame, answer.line_axes[i]);
  }

  void forget_manhattan() {
    line_axes.assign(frame.lines.size(), kNone);
    manhattan.reset();
  }

  void forget_matches() {
    point_landmarks.assign(frame.points.size(), kNone);
    line_landmarks.assign(frame.lines.size(), kNone);
  }

  // Takes the pose and the matches, not the features, for example from the keyframe that this frame became.
  template <class View>
  void read_back(const View& view) {
    cam_from_world = view.cam_from_world;
    const std::vector<LandmarkId>& points = view.point_landmarks;
    const std::vector<LandmarkId>& lines = view.line_landmarks;
    point_landmarks = points;
    line_landmarks = lines;
  }

  [[nodiscard]] Keyframe<S> to_keyframe() const {
    Keyframe<S> keyframe;
    keyframe.frame = frame;
    keyframe.frame.normals = {};  // they served the rotation stage
    keyframe.cam_from_world = cam_from_world;
    keyframe.line_axes = line_axes;
    keyframe.manhattan = manhattan;
    return std::move(keyframe).seeing(point_landmarks, line_landmarks);
  }
};

}  // namespace sslam
