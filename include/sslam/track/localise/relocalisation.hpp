// SPDX-License-Identifier: BSD-3-Clause
// Relocalisation: the place of a lost frame, among the keyframes that it may show.
#pragma once

#include <vector>

#include "sslam/track/contract/pose_estimate.hpp"
#include "sslam/track/localise/place_recognition.hpp"

namespace sslam {

template <Scalar S>
class Relocalisation {
 public:
  PlaceRecognition<S> places;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_stage("", self.places, visit);
  }

  // Compares the frame with `reference`, then with the keyframes that look most like it, and with one of all
  // in turn, until the pose at one of them is found, refined and agreed to by `agrees()`; `reference` becomes
  // that keyframe.
  template <class Fallback, class Refinement, class Agrees>
  [[nodiscard]] PoseEstimate<S> find(Map<S>& map, Fallback& fallback, Refinement& refinement, Agrees agrees,
                                     TrackedFrame<S>& frame, KeyframeId& reference) {
    candidates_.assign(1, reference);
    places.rank(map, frame.frame, candidates_);
    candidates_.push_back(next_in_turn(map));
    PoseEstimate<S> estimate;
    for (auto at = candidates_.begin(); at != candidates_.end() && !estimate.ok(); ++at) {
      frame.cam_from_world = map.keyframes[map.index(*at)].cam_from_world;
      estimate = fallback.track_keyframe(map, *at, nullptr, frame);
      if (estimate.ok()) estimate = refinement.refine(map, nullptr, frame);
      if (estimate.ok() && !agrees()) estimate.reason = Reason::kNoConsensus;
      if (estimate.ok()) reference = *at;
    }
    return estimate;
  }

 private:
  // The first keyframe is always alive.
  [[nodiscard]] KeyframeId next_in_turn(const Map<S>& map) noexcept {
    const auto count = static_cast<KeyframeId>(map.keyframes.size());
    do last_ = (last_ + 1) % count;
    while (!map.keyframes[map.index(last_)].alive());
    return last_;
  }

  std::vector<KeyframeId> candidates_;
  KeyframeId last_ = kNone;  // that was tried in turn
};

}  // namespace sslam
