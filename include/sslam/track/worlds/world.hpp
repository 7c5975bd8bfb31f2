// SPDX-License-Identifier: BSD-3-Clause
// A world: a map, the frames that were tracked in it, and where the camera was in it last. Monocular worlds
// have nothing in common, neither origin nor scale, until a place is seen that both know.
#pragma once

#include <optional>
#include <utility>

#include "sslam/track/contract/concepts.hpp"
#include "sslam/track/mapping/keyframe_cursor.hpp"
#include "sslam/track/worlds/map_trial.hpp"
#include "sslam/track/worlds/trajectory_log.hpp"

namespace sslam {

template <Scalar S>
struct World {
  int number = 0;  // worlds that were begun before
  Map<S> map;
  TrajectoryLog<S> log;
  KeyframeCursor<S> cursor;
  MapTrial<S> trial;  // as it stood when the world was left
  std::optional<PlaceMatch<S>>
      met;  // the world that the camera is in since, and has not been joined with yet

  // The map has become another elsewhere.
  void follow(const MapChange<S>& change) {
    if (change.loop_closed) log.follow([&](KeyframeId id) { return change.scale_at(id); });
    cursor.refer_to(map.surviving(cursor.reference()));
  }

  // `other`, the camera's world until now, becomes part of this one, where one of its keyframes was met.
  template <LoopStage<S> Loops>
  MapJoint<S> take_in(World other, const Loop<S>& place, Loops& loops) {
    const KeyframeId id = other.cursor.reference();
    const MapJoint<S> joint = loops.merge(map, std::move(other.map), id, place);
    log.append(other.log, joint.shift.keyframes, joint.moved.scale);
    cursor = other.cursor;
    cursor.refer_to(id + joint.shift.keyframes);
    return joint;
  }
};

}  // namespace sslam
