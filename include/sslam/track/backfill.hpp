// SPDX-License-Identifier: BSD-3-Clause
// Backfill: the frames that passed while the first map was still being waited for get their poses once it
// stands.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>

#include "sslam/track/trajectory_log.hpp"
#include "sslam/track/translation.hpp"

namespace sslam {

template <Scalar S>
class Backfill {
 public:
  std::size_t max_frames = 150;  // that are kept while waiting: about 5 s, 100 kB each

  void keep(const TrackedFrame<S>& frame) {
    if (max_frames == 0) return;
    if (waiting_.size() == max_frames) waiting_.pop_front();
    waiting_.push_back(frame);
  }

  void clear() { waiting_.clear(); }

  // Tracks the waiting frames one after the other, away from the two keyframes of the first map: between them
  // from the first until one fails, then from the second; before them backwards. Poses go into the log.
  template <class Fallback, class Refinement>
  void run(Map<S>& map, Fallback& fallback, Refinement& refinement, TrajectoryLog<S>& log) {
    const Keyframe<S>& first = map.keyframes.front();
    const Keyframe<S>& second = map.keyframes.back();
    const auto position = [&](std::int64_t index) {  // of the first waiting frame that is not before `index`
      const auto at = std::find_if(waiting_.begin(), waiting_.end(),
                                   [&](const TrackedFrame<S>& f) { return f.frame.index >= index; });
      return at - waiting_.begin();
    };
    const auto sweep = [&](const Keyframe<S>& from, std::ptrdiff_t begin, std::ptrdiff_t end,
                           std::ptrdiff_t step) {
      previous_.point_landmarks = from.point_landmarks;
      previous_.line_landmarks = from.line_landmarks;
      previous_.cam_from_world = from.cam_from_world;
      std::ptrdiff_t i = begin;
      for (; i != end; i += step)
        if (!track(waiting_[static_cast<std::size_t>(i)], from.id, map, fallback, refinement, log)) break;
      return i;
    };
    const std::ptrdiff_t after_first = position(first.frame.index + 1);
    const std::ptrdiff_t failed = sweep(first, after_first, position(second.frame.index), 1);
    sweep(second, position(second.frame.index) - 1, failed - 1, -1);
    sweep(first, position(first.frame.index) - 1, -1, -1);
    waiting_.clear();
  }

 private:
  template <class Fallback, class Refinement>
  bool track(TrackedFrame<S>& frame, KeyframeId reference, Map<S>& map, Fallback& fallback,
             Refinement& refinement, TrajectoryLog<S>& log) {
    recent_.gather(previous_, previous_);
    frame.cam_from_world = previous_.cam_from_world;
    if (!fallback.track(map, recent_, nullptr, frame).ok()) return false;
    if (!refinement.refine(map, nullptr, frame).ok()) return false;
    log.add(map, frame.frame.index, frame.frame.stamp, reference, frame.cam_from_world);
    previous_.point_landmarks = frame.point_landmarks;
    previous_.line_landmarks = frame.line_landmarks;
    previous_.cam_from_world = frame.cam_from_world;
    return true;
  }

  std::deque<TrackedFrame<S>> waiting_;
  TrackedFrame<S> previous_;  // its matches and its pose alone
  RecentLandmarks<S> recent_;
};

}  // namespace sslam
