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

  // Tracks the waiting frames outwards from the first keyframe, one after the other in each direction, until
  // one fails. The map's two keyframes are the first map; poses go into the log.
  template <class Fallback, class Refinement>
  void run(Map<S>& map, Fallback& fallback, Refinement& refinement, TrajectoryLog<S>& log) {
    const Keyframe<S>& reference = map.keyframes.front();
    const auto after = std::find_if(waiting_.begin(), waiting_.end(), [&](const TrackedFrame<S>& f) {
      return f.frame.index > reference.frame.index;
    });
    const auto split = static_cast<std::ptrdiff_t>(after - waiting_.begin());
    const auto count = static_cast<std::ptrdiff_t>(waiting_.size());
    sweep(split, count, 1, map, fallback, refinement, log);
    const bool holds_reference =
        split > 0 && waiting_[static_cast<std::size_t>(split - 1)].frame.index == reference.frame.index;
    sweep(split - 1 - (holds_reference ? 1 : 0), -1, -1, map, fallback, refinement, log);
    waiting_.clear();
  }

 private:
  template <class Fallback, class Refinement>
  void sweep(std::ptrdiff_t from, std::ptrdiff_t to, std::ptrdiff_t step, Map<S>& map, Fallback& fallback,
             Refinement& refinement, TrajectoryLog<S>& log) {
    const Keyframe<S>& reference = map.keyframes.front();
    TrackedFrame<S> previous;
    previous.point_landmarks = reference.point_landmarks;
    previous.line_landmarks = reference.line_landmarks;
    previous.cam_from_world = reference.cam_from_world;
    for (std::ptrdiff_t i = from; i != to; i += step) {
      TrackedFrame<S>& frame = waiting_[static_cast<std::size_t>(i)];
      recent_.gather(previous, previous);
      frame.cam_from_world = previous.cam_from_world;
      if (!fallback.track(map, recent_, nullptr, frame).ok()) return;
      if (!refinement.refine(map, nullptr, frame).ok()) return;
      log.add(map, frame.frame.index, frame.frame.stamp, reference.id, frame.cam_from_world);
      previous.point_landmarks = frame.point_landmarks;
      previous.line_landmarks = frame.line_landmarks;
      previous.cam_from_world = frame.cam_from_world;
    }
  }

  std::deque<TrackedFrame<S>> waiting_;
  RecentLandmarks<S> recent_;
};

}  // namespace sslam
