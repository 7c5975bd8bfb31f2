// SPDX-License-Identifier: BSD-3-Clause
// A frame on its way through the tracker: features, an index over them, the landmarks they see, and a pose.
#pragma once

#include <optional>
#include <vector>

#include "sslam/map/feature_grid.hpp"
#include "sslam/map/keyframe.hpp"

namespace sslam {

template <Scalar S>
struct TrackedFrame {
  Frame<S> frame;
  FeatureGrid<S> grid;                      // over frame.points
  std::vector<LandmarkId> point_landmarks;  // one for each frame.points, kNone where there is none
  std::vector<LandmarkId> line_landmarks;   // one for each frame.lines
  std::vector<std::int8_t> line_axes;       // number of each line's Manhattan axis, or kNone
  std::optional<RotationObservation<S>> manhattan;
  std::size_t manhattan_frame = 0;  // of the map's, that this rotation comes from
  SE3<S> cam_from_world;

  // Takes over the features by swapping, so that both sides keep their buffers.
  void adopt(Frame<S>& source) {
    std::swap(frame, source);
    grid.build(frame.points, frame.width, frame.height);
    forget_manhattan();
    forget_matches();
  }

  void forget_manhattan() {
    line_axes.assign(frame.lines.size(), kNone);
    manhattan.reset();
  }

  void forget_matches() {
    point_landmarks.assign(frame.points.size(), kNone);
    line_landmarks.assign(frame.lines.size(), kNone);
  }

  // Takes over the pose and the matches, not the features: from the keyframe that this frame has become, say.
  template <class View>
  void read_back(const View& view) {
    cam_from_world = view.cam_from_world;
    point_landmarks = view.point_landmarks;
    line_landmarks = view.line_landmarks;
  }

  [[nodiscard]] Keyframe<S> to_keyframe() const {
    Keyframe<S> keyframe;
    keyframe.frame = frame;
    keyframe.frame.normals = {};  // they served the rotation stage
    keyframe.cam_from_world = cam_from_world;
    keyframe.point_landmarks = point_landmarks;
    keyframe.line_landmarks = line_landmarks;
    keyframe.line_axes = line_axes;
    keyframe.manhattan = manhattan;
    return keyframe;
  }
};

}  // namespace sslam
