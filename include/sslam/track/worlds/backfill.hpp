// SPDX-License-Identifier: BSD-3-Clause
// Backfill: frames that passed without a pose get one later: those that a first map was waited for in, once
// it stands, and those that were lost, once the camera is found again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include "sslam/core/parameter.hpp"
#include "sslam/track/contract/concepts.hpp"
#include "sslam/track/localise/pose_certainty.hpp"
#include "sslam/track/mapping/keyframe_cursor.hpp"
#include "sslam/track/worlds/neighbour_tracking.hpp"
#include "sslam/track/worlds/trajectory_log.hpp"
#include "sslam/track/worlds/waiting_frames.hpp"

namespace sslam {

template <Scalar S>
struct BackfillOptions {
  std::size_t max_frames = 150;  // that are kept while waiting: about 5 s, 100 kB each, which stays in use
  int max_misses = 5;            // frames in a row, as blurred ones are, beyond which a sweep may go on

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_frames", self.max_frames, Unit::kCount, 0, 100000,
          "without a pose that are kept, 100 kB each, until they can get one; 0: they get none");
    visit("max_misses", self.max_misses, Unit::kCount, 0, 1000,
          "frames in a row that may stay without a pose while those behind them get one");
  }
};
static_assert(Described<BackfillOptions<double>>);

template <Scalar S>
class Backfill {
 public:
  BackfillOptions<S> options;

  // `placed`: the frame has a pose, in a map that may yet be given up.
  void keep(const TrackedFrame<S>& frame, bool placed) {
    if (options.max_frames == 0) return;
    waiting_.add(frame, placed, options.max_frames);
  }

  void clear() { waiting_.clear(); }

  // The world in which rotations and poses were seen is given up.
  void leave_world() {
    for (std::ptrdiff_t i = 0; i < waiting_.size(); ++i) {
      waiting_[i].frame.forget_manhattan();
      waiting_[i].placed = false;
    }
  }

  // Tracks the waiting frames one after the other, away from the first and the last keyframe of the first
  // map: between them from the first until track is lost, then from the last; before them backwards. Poses go
  // into the log, and keyframes of those that are certain into the map, as they do forwards.
  template <class Fallback, class Refinement, class Keyframes, class Mapping>
  void run(Map<S>& map, Fallback& fallback, Refinement& refinement, const PoseCertainty<S>& certainty,
           const Keyframes& keyframes, Mapping& mapping, TrajectoryLog<S>& log) {
    const auto position = [&](KeyframeId id, int after) {  // of the first waiting frame past the keyframe's
      const std::int64_t index = map.keyframes[map.index(id)].frame.index + after;
      std::ptrdiff_t at = 0;
      while (at < waiting_.size() && waiting_[at].frame.frame.index < index) ++at;
      return at;
    };
    const auto sweep_from = [&](KeyframeId from, std::ptrdiff_t begin, std::ptrdiff_t end,
                                std::ptrdiff_t step) {
      cursor_.move_to(from, map.keyframes[map.index(from)].frame.stamp);
      previous_.read_back(map.keyframes[map.index(from)]);
      return sweep(
          map, fallback, refinement, begin, end, step,
          [&](TrackedFrame<S>& frame, const PoseEstimate<S>& estimate) {
            if (certainty.certain(estimate))
              cursor_.advance(map, frame, estimate, keyframes,
                              [&](S depth) { return mapping.insert(map, frame, depth); });
            return cursor_.reference();
          },
          log);
    };
    const KeyframeId first = map.keyframes.front().id, last = map.keyframes.back().id;
    const std::ptrdiff_t after_first = position(first, 1);
    const std::ptrdiff_t before_last = std::max(after_first, position(last, 0));
    const std::ptrdiff_t rest = sweep_from(first, after_first, before_last, 1);
    sweep_from(last, before_last - 1, rest - 1, -1);
    sweep_from(first, position(first, 0) - 1, -1, -1);
    waiting_.clear();
  }

  // A lost frame has just been found, and `reference` is the keyframe next to it: the frames before it that
  // were lost as well are tracked backwards from it, as far as that goes. The map stays as it is.
  template <class Fallback, class Refinement>
  void run_back(Map<S>& map, Fallback& fallback, Refinement& refinement, const TrackedFrame<S>& found,
                KeyframeId reference, TrajectoryLog<S>& log) {
    std::ptrdiff_t last_placed = waiting_.size() - 1;
    while (last_placed >= 0 && !waiting_[last_placed].placed) --last_placed;
    previous_.read_back(found);
    sweep(
        map, fallback, refinement, waiting_.size() - 1, last_placed, -1,
        [&](const TrackedFrame<S>&, const PoseEstimate<S>&) { return reference; }, log);
  }

 private:
  // Tracks the waiting frames from `begin` on, each from previous_, until too many in a row have no pose.
  // Those that have one are shown to take(frame, estimate), which answers with their reference keyframe, and
  // go into the log. The position after the last of them.
  template <class Fallback, class Refinement, class Take>
  std::ptrdiff_t sweep(Map<S>& map, Fallback& fallback, Refinement& refinement, std::ptrdiff_t begin,
                       std::ptrdiff_t end, std::ptrdiff_t step, Take take, TrajectoryLog<S>& log) {
    std::ptrdiff_t next = begin;
    for (std::ptrdiff_t i = begin; i != end && std::abs(i - next) <= options.max_misses; i += step) {
      auto& waiting = waiting_[i];
      TrackedFrame<S>& frame = waiting.frame;
      frame.cam_from_world = previous_.cam_from_world;
      const PoseEstimate<S> estimate =
          neighbours_.track(previous_, previous_, map, fallback, refinement, frame);
      if (!estimate.ok()) continue;
      const KeyframeId reference = take(frame, estimate);
      log.add(map, frame.frame.index, frame.frame.stamp, reference, frame.cam_from_world);
      previous_.read_back(frame);
      waiting.placed = true;
      next = i + step;
    }
    return next;
  }

  WaitingFrames<S> waiting_;
  TrackedFrame<S> previous_;  // its matches and its pose alone
  NeighbourTracking<S> neighbours_;
  KeyframeCursor<S> cursor_;
};

}  // namespace sslam
