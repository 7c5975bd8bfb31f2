// SPDX-License-Identifier: BSD-3-Clause
// Extends the finished map into frames without a pose that follow or precede frames with one: those of a map
// that was given up, say. These frames show more than the map holds, so keyframes are made on the way, as
// while a run goes on.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "sslam/track/mapping/keyframe_cursor.hpp"
#include "sslam/track/matching/frame_turn.hpp"
#include "sslam/track/worlds/neighbour_tracking.hpp"
#include "sslam/track/worlds/trajectory_log.hpp"

namespace sslam {

template <Scalar S>
class MapExtension {
 public:
  // Walks from the keyframe nearest to each gap into the gap, backwards in time first. A walk ends where the
  // next frame with a pose is reached, or after `max_misses` frames in a row that cannot be tracked. `look(i,
  // keyframe)`: features of frame i, to be tracked beside that keyframe. `stages`: the pipeline's. The log is
  // sorted.
  template <class Look, class Stages>
  void run(std::span<const Frame<S>> frames, int max_misses, Look look, Map<S>& map, Stages& stages,
           TrajectoryLog<S>& log) {
    const auto known = [&](std::ptrdiff_t i) { return log.find(at(frames, i).index) != nullptr; };
    const auto size = static_cast<std::ptrdiff_t>(frames.size());
    for (const std::ptrdiff_t step : {-1, 1}) {
      const std::ptrdiff_t end = step < 0 ? -1 : size;
      std::ptrdiff_t i = step < 0 ? size - 1 : 0;
      while (i != end && !known(i)) i += step;
      while (i != end) {
        while (i != end && known(i)) i += step;
        if (i == end) break;
        const std::ptrdiff_t edge = i - step;
        while (i != end && !known(i)) i += step;
        walk(frames, edge, i, step, max_misses, look, map, stages, log);
      }
    }
  }

 private:
  [[nodiscard]] static const Frame<S>& at(std::span<const Frame<S>> frames, std::ptrdiff_t i) {
    return frames[static_cast<std::size_t>(i)];
  }

  // From the keyframe nearest to `edge`, the last frame with a pose, up to `end`. Frames on the way to the
  // edge are tracked again: they become keyframes as well, so that what they share with the gap is in the
  // map.
  template <class Look, class Stages>
  void walk(std::span<const Frame<S>> frames, std::ptrdiff_t edge, std::ptrdiff_t end, std::ptrdiff_t step,
            int max_misses, Look look, Map<S>& map, Stages& stages, TrajectoryLog<S>& log) {
    std::ptrdiff_t last = begin_at_keyframe(frames, edge, step, map, log);
    for (std::ptrdiff_t i = last + step; i != end && step * (i - last) <= max_misses + 1; i += step) {
      Frame<S> frame = look(static_cast<std::size_t>(i), cursor_.reference());
      frame_.adopt(frame);
      const PoseEstimate<S> estimate = track(at(frames, last), map, stages);
      if (!estimate.ok()) continue;
      if (stages.certainty.certain(estimate))
        cursor_.advance(map, frame_, estimate, stages.keyframes,
                        [&](S depth) { return stages.mapping.insert(map, frame_, depth); });
      log.set(map, frame_.frame.index, frame_.frame.stamp, cursor_.reference(), frame_.cam_from_world);
      previous_.read_back(frame_);
      last = i;
    }
  }

  // Starts from where `last`, the frame before, is; then, if that fails, with the turn since then that the
  // features of both frames show.
  template <class Stages>
  [[nodiscard]] PoseEstimate<S> track(const Frame<S>& last, Map<S>& map, Stages& stages) {
    const auto track_from = [&](const SE3<S>& pose) {
      frame_.forget_matches();
      frame_.cam_from_world = pose;
      return neighbours_.track(previous_, previous_, map, stages.fallback, stages.refinement, frame_);
    };
    const PoseEstimate<S> estimate = track_from(previous_.cam_from_world);
    if (estimate.ok()) return estimate;
    const std::optional<SO3<S>> turn = turn_.between(last, frame_.frame);
    return turn ? track_from(turned(*turn, previous_.cam_from_world)) : estimate;
  }

  // The position, from `edge` away from the gap, of the first frame that is a keyframe, or before which
  // frames have no pose.
  std::ptrdiff_t begin_at_keyframe(std::span<const Frame<S>> frames, std::ptrdiff_t edge, std::ptrdiff_t step,
                                   const Map<S>& map, const TrajectoryLog<S>& log) {
    const auto size = static_cast<std::ptrdiff_t>(frames.size());
    for (std::ptrdiff_t i = edge;; i -= step) {
      const TrajectoryEntry<S>& entry = *log.find(at(frames, i).index);
      const Keyframe<S>& keyframe = map.keyframes[map.index(map.surviving(entry.reference))];
      const std::ptrdiff_t before = i - step;
      const bool more = before >= 0 && before < size && log.find(at(frames, before).index) != nullptr;
      if (more && !keyframe.made_of(at(frames, i))) continue;
      cursor_.move_to(keyframe.id, keyframe.frame.stamp);
      previous_.read_back(keyframe);
      previous_.cam_from_world = TrajectoryLog<S>::pose(map, entry);
      return i;
    }
  }

  TrackedFrame<S> frame_, previous_;  // of the latter the matches and the pose alone
  NeighbourTracking<S> neighbours_;
  FrameTurn<S> turn_;
  KeyframeCursor<S> cursor_;
};

}  // namespace sslam
