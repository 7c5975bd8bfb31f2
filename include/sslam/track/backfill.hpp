// SPDX-License-Identifier: BSD-3-Clause
// Backfill: the frames that passed while the first map was still being waited for, or while one was tried
// that was then given up, get their poses once it stands.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <deque>

#include "sslam/track/keyframe_cursor.hpp"
#include "sslam/track/trajectory_log.hpp"
#include "sslam/track/translation.hpp"

namespace sslam {

template <Scalar S>
class Backfill {
 public:
  std::size_t max_frames = 150;  // that are kept while waiting: about 5 s, 100 kB each
  int max_misses = 5;            // frames in a row, as blurred ones are, beyond which a sweep may go on

  void keep(const TrackedFrame<S>& frame) {
    if (max_frames == 0) return;
    if (waiting_.size() == max_frames) waiting_.pop_front();
    waiting_.push_back(frame);
  }

  void clear() { waiting_.clear(); }

  // The world in which rotations were seen is given up.
  void leave_world() {
    for (TrackedFrame<S>& frame : waiting_) frame.forget_manhattan();
  }

  // Tracks the waiting frames one after the other, away from the first and the last keyframe of the first
  // map: between them from the first until track is lost, then from the last; before them backwards. Poses go
  // into the log, and keyframes into the map, as they do forwards.
  template <class Fallback, class Refinement, class Keyframes, class Mapping>
  void run(Map<S>& map, Fallback& fallback, Refinement& refinement, const Keyframes& keyframes,
           Mapping& mapping, TrajectoryLog<S>& log) {
    const auto position = [&](KeyframeId id, int after) {  // of the first waiting frame past the keyframe's
      const std::int64_t index = map.keyframes[map.index(id)].frame.index + after;
      const auto at = std::find_if(waiting_.begin(), waiting_.end(),
                                   [&](const TrackedFrame<S>& f) { return f.frame.index >= index; });
      return at - waiting_.begin();
    };
    const auto sweep = [&](KeyframeId from, std::ptrdiff_t begin, std::ptrdiff_t end, std::ptrdiff_t step) {
      cursor_.move_to(from);
      previous_.read_back(map.keyframes[map.index(from)]);
      std::ptrdiff_t next = begin;  // after the last frame that was tracked
      for (std::ptrdiff_t i = begin; i != end && std::abs(i - next) <= max_misses; i += step) {
        TrackedFrame<S>& frame = waiting_[static_cast<std::size_t>(i)];
        const PoseEstimate<S> estimate = track(frame, map, fallback, refinement);
        if (!estimate.ok()) continue;
        cursor_.advance(map, frame, estimate, keyframes,
                        [&](S depth) { return mapping.insert(map, frame, depth); });
        log.add(map, frame.frame.index, frame.frame.stamp, cursor_.reference(), frame.cam_from_world);
        previous_.read_back(frame);
        next = i + step;
      }
      return next;
    };
    const KeyframeId first = map.keyframes.front().id, last = map.keyframes.back().id;
    const std::ptrdiff_t after_first = position(first, 1);
    const std::ptrdiff_t before_last = std::max(after_first, position(last, 0));
    const std::ptrdiff_t rest = sweep(first, after_first, before_last, 1);
    sweep(last, before_last - 1, rest - 1, -1);
    sweep(first, position(first, 0) - 1, -1, -1);
    waiting_.clear();
  }

 private:
  template <class Fallback, class Refinement>
  PoseEstimate<S> track(TrackedFrame<S>& frame, Map<S>& map, Fallback& fallback, Refinement& refinement) {
    recent_.gather(previous_, previous_);
    frame.cam_from_world = previous_.cam_from_world;
    const PoseEstimate<S> estimate = fallback.track(map, recent_, nullptr, frame);
    return estimate.ok() ? refinement.refine(map, nullptr, frame) : estimate;
  }

  std::deque<TrackedFrame<S>> waiting_;
  TrackedFrame<S> previous_;  // its matches and its pose alone
  RecentLandmarks<S> recent_;
  KeyframeCursor<S> cursor_;
};

}  // namespace sslam
