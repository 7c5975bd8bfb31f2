// SPDX-License-Identifier: BSD-3-Clause
// Where a walk along the frames stands in the map: its reference keyframe, and when the next one is due.
#pragma once

#include <cmath>

#include "sslam/track/contract/pose_estimate.hpp"
#include "sslam/track/matching/correspondences.hpp"

namespace sslam {

template <Scalar S>
class KeyframeCursor {
 public:
  [[nodiscard]] KeyframeId reference() const noexcept { return reference_; }

  // The reference is a keyframe that was made, or may be taken for made, at `stamp`.
  void move_to(KeyframeId keyframe, double stamp) noexcept {
    reference_ = keyframe;
    last_ = stamp;
  }

  // The reference is another, as after a relocalisation; how long ago the last keyframe was stays.
  void refer_to(KeyframeId keyframe) noexcept { reference_ = keyframe; }

  // Takes the tracked frame into the map where the keyframe stage says so: insert(median depth) answers with
  // its id, or with kNone where the map cannot take it. True if it has.
  template <class Keyframes, class Insert>
  bool advance(const Map<S>& map, const TrackedFrame<S>& frame, const PoseEstimate<S>& estimate,
               const Keyframes& keyframes, Insert insert) {
    const S depth = scene_depth(map, frame);
    const int inliers = estimate.point_inliers + estimate.line_inliers;
    if (!keyframes.choose(map, reference_, frame, inliers, std::abs(frame.frame.stamp - last_), depth))
      return false;
    const KeyframeId id = insert(depth);
    if (id == kNone) return false;
    move_to(id, frame.frame.stamp);
    return true;
  }

  // Median depth of what the frame sees of the map.
  [[nodiscard]] S scene_depth(const Map<S>& map, const TrackedFrame<S>& frame) {
    seen_.gather(map, frame);
    return seen_.median_depth(frame.cam_from_world);
  }

 private:
  KeyframeId reference_ = kNone;
  double last_ = 0;  // stamp of the last keyframe
  Correspondences<S> seen_;
};

}  // namespace sslam
