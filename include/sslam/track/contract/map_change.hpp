// SPDX-License-Identifier: BSD-3-Clause
// How the map changed between two of its snapshots. Moves poses and matches from the old map to the new one.
#pragma once

#include <vector>

#include "sslam/track/contract/map_messages.hpp"

namespace sslam {

template <Scalar S>
struct MapChange {
  const Map<S>* before = nullptr;
  const Map<S>* now = nullptr;
  const std::vector<S>* scales_before = nullptr;  // as in MapSnapshot
  const std::vector<S>* scales_now = nullptr;
  std::size_t known = 0;  // number of keyframes in the snapshot before
  bool loop_closed = false;

  // Factor of lengths at the keyframe.
  [[nodiscard]] S scale_at(KeyframeId keyframe) const {
    return (*scales_now)[Map<S>::index(keyframe)] / (*scales_before)[Map<S>::index(keyframe)];
  }

  // The new cam_from_world of a camera that moves with the keyframe.
  [[nodiscard]] SE3<S> pose(KeyframeId keyframe, const SE3<S>& cam_from_world) const {
    SE3<S> cam_from_keyframe = cam_from_world * before->pose(keyframe).inverse();
    cam_from_keyframe.translation *= scale_at(keyframe);
    return cam_from_keyframe * now->pose(keyframe);
  }

  void forget_gone_matches(std::vector<LandmarkId>& point_landmarks,
                           std::vector<LandmarkId>& line_landmarks) const {
    forget_gone(point_landmarks, now->points, known);
    forget_gone(line_landmarks, now->lines, known);
  }

  // Moves a frame with its reference keyframe. Matches with erased landmarks are dropped.
  void carry(KeyframeId reference, TrackedFrame<S>& frame) const {
    frame.cam_from_world = pose(reference, frame.cam_from_world);
    forget_gone_matches(frame.point_landmarks, frame.line_landmarks);
  }
};

}  // namespace sslam
