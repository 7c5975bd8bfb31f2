// SPDX-License-Identifier: BSD-3-Clause
// Keyframe choice: a frame joins the map when it shares too little with its reference keyframe, when much
// comes into view that is new, or when it has moved far enough to give new parallax.
#pragma once

#include <algorithm>

#include "sslam/core/parameter.hpp"
#include "sslam/map/map.hpp"
#include "sslam/track/contract/concepts.hpp"

namespace sslam {

template <Scalar S>
struct KeyframeOptions {
  S min_shared = S(0.5);        // share of the reference keyframe's landmarks that the frame still sees
  S max_baseline = S(0.08);     // distance to the reference keyframe over the median scene depth
  S max_turn = radians(S(12));  // rotation against the reference keyframe
  double min_gap = 0.05;        // seconds between keyframes: every second frame of a video, each one at 10 Hz

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("min_shared", self.min_shared, Unit::kShare, 0, 1,
          "of the reference keyframe's landmarks still seen");
    visit("max_baseline", self.max_baseline, Unit::kNumber, 0, 10,
          "distance to the reference keyframe over the median scene depth");
    visit("max_turn", self.max_turn, Unit::kDegrees, 0, 180, "rotation against the reference keyframe");
    visit("min_gap", self.min_gap, Unit::kSeconds, 0, 3600, "between keyframes");
  }
};
static_assert(Described<KeyframeOptions<double>>);

template <Scalar S>
class SharedFeatureKeyframes {
 public:
  KeyframeOptions<S> options;

  [[nodiscard]] bool choose(const Map<S>& map, KeyframeId reference, const TrackedFrame<S>& frame,
                            int inliers, double seconds_since, S median_depth) const {
    if (seconds_since < options.min_gap) return false;
    const Keyframe<S>& keyframe = map.keyframes[map.index(reference)];
    const auto landmarks =
        static_cast<S>(count_held(keyframe.point_landmarks) + count_held(keyframe.line_landmarks));
    // The map is to know as much of the frame's features as of the keyframe's: behind a door, all that was
    // seen through it may be in view still and little of the room be known.
    const auto features = static_cast<S>(frame.frame.points.size() + frame.frame.lines.size());
    const auto had = static_cast<S>(keyframe.frame.points.size() + keyframe.frame.lines.size());
    const S news = std::max(S(1), features / std::max(had, S(1)));
    const SE3<S> frame_from_reference = frame.cam_from_world * keyframe.cam_from_world.inverse();
    return static_cast<S>(inliers) < options.min_shared * landmarks * news ||
           frame_from_reference.translation.norm() > options.max_baseline * median_depth ||
           frame_from_reference.rotation.log().norm() > options.max_turn;
  }
};
static_assert(KeyframeStage<SharedFeatureKeyframes<double>, double>);

// Keeps the map as initialisation left it.
template <Scalar S>
struct NoKeyframes {
  [[nodiscard]] bool choose(const Map<S>&, KeyframeId, const TrackedFrame<S>&, int, double, S) const {
    return false;
  }
};
static_assert(KeyframeStage<NoKeyframes<double>, double>);

}  // namespace sslam
