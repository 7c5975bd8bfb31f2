// SPDX-License-Identifier: BSD-3-Clause
// A frame is tracked from frames beside it after it has passed, without a Manhattan frame and without motion:
// the landmarks that these see are looked for, and the pose is refined.
#pragma once

#include "sslam/map/map.hpp"
#include "sslam/track/contract/pose_estimate.hpp"
#include "sslam/track/contract/recent_landmarks.hpp"

namespace sslam {

template <Scalar S>
class NeighbourTracking {
 public:
  // `frame` has the pose to start from; on failure its pose and matches are what the stages left.
  template <class Fallback, class Refinement>
  [[nodiscard]] PoseEstimate<S> track(const TrackedFrame<S>& beside, const TrackedFrame<S>& behind,
                                      Map<S>& map, Fallback& fallback, Refinement& refinement,
                                      TrackedFrame<S>& frame) {
    recent_.gather(beside, behind);
    const PoseEstimate<S> estimate = fallback.track(map, recent_, nullptr, frame);
    return estimate.ok() ? refinement.refine(map, nullptr, frame) : estimate;
  }

 private:
  RecentLandmarks<S> recent_;  // keeps its capacity
};

}  // namespace sslam
