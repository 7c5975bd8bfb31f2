// SPDX-License-Identifier: BSD-3-Clause
// Which world the camera is in: worlds are begun, left, entered again and joined, and all that the stages
// remember of one follows.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "sslam/track/pose_tracking.hpp"
#include "sslam/track/worlds/atlas.hpp"
#include "sslam/track/worlds/backfill.hpp"
#include "sslam/track/worlds/drifted_frames.hpp"

namespace sslam {

template <Scalar S, StageSet<S> Stages>
class WorldKeeping : public PoseTracking<S, Stages> {
 public:
  using PoseTracking<S, Stages>::evidence, PoseTracking<S, Stages>::motion;
  using PoseTracking<S, Stages>::rotation, PoseTracking<S, Stages>::stance;
  typename Stages::Initialisation initialisation;
  typename Stages::Keyframes keyframes;
  typename Stages::Mapping mapping;
  typename Stages::Loops loops;
  Backfill<S> backfill;
  MapTrial<S> trial;
  Atlas<S> atlas;
  typename Stages::Final final_pass;
  typename Stages::Upkeep
      upkeep;  // after the stages that it may still be at work with when the pipeline ends

  // The worlds that there are, the camera's first, and the number of the one that was begun last: what
  // go_on() takes.
  [[nodiscard]] std::vector<const World<S>*> worlds() const {
    std::vector<const World<S>*> all{&world_};
    for (const World<S>& world : atlas.worlds()) all.push_back(&world);
    return all;
  }
  [[nodiscard]] int last_number() const noexcept { return last_number_; }

 protected:
  [[nodiscard]] const Keyframe<S>& reference() const {
    return world_.map.keyframes[world_.map.index(world_.cursor.reference())];
  }

  // The map has changed under the frames in hand; true if a loop was closed.
  bool follow_map(const MapChange<S>* change) {
    if (change == nullptr) return false;
    const KeyframeId fixed = world_.cursor.reference();
    for (TrackedFrame<S>& frame : frames_.all()) change->carry(fixed, frame);
    motion.move_to(frames_.current().cam_from_world, change->scale_at(fixed));
    world_.follow(*change);
    return change->loop_closed;
  }

  // The frame has just become a keyframe; the world may move under it. True if a loop was closed.
  bool close_loop() {
    TrackedFrame<S>& frame = frames_.current();
    const LoopAnswer<S> answer = upkeep.close(world_.map, world_.cursor.reference(), loops);
    if (!answer.closed) return false;
    frame.read_back(reference());
    follow_loop(answer);
    motion.move_to(frame.cam_from_world, answer.scale_at(world_.cursor.reference()));
    return true;
  }

  // Before the final pass: what had drifted is withdrawn, and places that were met once, and left before they
  // were seen a second time, close their loops. True if one did.
  bool prepare_final_pass() {
    if (world_.map.empty()) return false;
    const bool withdrawn = drifted_.withdraw(world_.map, world_.log);
    world_.cursor.refer_to(world_.map.surviving(world_.cursor.reference()));
    const KeyframeId fixed = world_.cursor.reference();
    TrackedFrame<S>& frame = frames_.current();
    SE3<S> from_fixed = frame.cam_from_world * world_.map.pose(fixed).inverse();
    bool closed = false;
    S scale = 1;
    const std::vector<KeyframeId> missed = loops.missed(world_.map);
    for (const TrialEvidence speaking : {TrialEvidence::kBeside, TrialEvidence::kLikelyDrift}) {
      if (closed) break;
      for (const KeyframeId id : missed) {
        const LoopAnswer<S> answer = loops.close_on_trial(world_.map, id, speaking);
        closed = closed || answer.closed;
        follow_loop(answer);
        scale *= answer.scale_at(fixed);
      }
    }
    if (!closed && !withdrawn) return false;
    from_fixed.translation *= scale;
    frame.cam_from_world = from_fixed * world_.map.pose(fixed);
    frame.forget_matches();
    frames_.change_world();
    motion.move_to(frame.cam_from_world, scale);
    return closed;
  }

  // The map of this world refutes it, or the camera has left it.
  void give_up_world(bool lay_aside) {
    if (lay_aside) {
      leave_world();
      atlas.lay_aside(std::move(world_));
    }
    start_over({});
    world_.number = ++last_number_;
  }

  void start_over(Map<S> map) {
    upkeep.forget();
    world_ = {};
    world_.map = std::move(map);
    trial.begin_again();
    frames_.current().forget_manhattan();
    enter_world();
  }

  // These worlds, of which maps and logs are known, take the place of all.
  void take_over(std::vector<World<S>> known, int begun_last) {
    start_over({});
    last_number_ = begun_last;
    for (World<S>& world : known) {
      world.trial = trial;
      if (world.map.empty()) continue;
      const Keyframe<S>& latest =
          world.map.keyframes[world.map.index(world.map.surviving(world.map.keyframes.back().id))];
      world.cursor.move_to(latest.id, latest.frame.stamp);
    }
    atlas.worlds().clear();
    for (std::size_t i = 1; i < known.size(); ++i) atlas.lay_aside(std::move(known[i]));
    world_ = std::move(known.front());
    enter_world();
  }

  // The current frame is in the other world, and what was the world until now is laid aside for it.
  void change_places(World<S>& other) {
    leave_world();
    std::swap(world_, other);
    trial = world_.trial;
    frames_.change_world();
    enter_world();
  }

  // The camera's world becomes part of a known one, where the current frame shows a place of that.
  void join(World<S> known, const Loop<S>& place) {
    const MapJoint<S> joint = known.take_in(std::move(world_), place, loops);
    world_ = std::move(known);
    for (TrackedFrame<S>& frame : frames_.all()) {
      joint.shift.apply_to_matches(frame.point_landmarks, frame.line_landmarks);
      frame.cam_from_world = carried(joint.moved, frame.cam_from_world);
    }
    TrackedFrame<S>& frame = frames_.current();
    frame.read_back(reference());
    motion.move_to(frame.cam_from_world, joint.moved.scale);
    rotation.forget();
    trial = world_.trial;
    trial.end_loss();
    trial.drift.end();
    atlas.forget_place_matches();
  }

  World<S> world_;
  FrameHistory<S> frames_;
  DriftedFrames drifted_;
  decltype(std::as_const(loops).finder()) finder_;  // for worlds that were left

 private:
  void follow_loop(const LoopAnswer<S>& answer) {
    if (!answer.new_from_old.empty()) world_.log.follow([&](KeyframeId id) { return answer.scale_at(id); });
  }

  // What mapping elsewhere has still to say comes in, and nothing after that.
  void leave_world() {
    if (const MapChange<S>* change = upkeep.finish(world_.map)) world_.follow(*change);
    upkeep.forget();
    world_.trial = trial;
    finder_ = loops.finder();
  }

  // The world is another one: what the stages remember was of that before it.
  void enter_world() {
    rotation.forget();
    evidence.begin_again();
    stance.begin(world_.map.empty());
    initialisation.reset();
    loops.forget();
    motion.stop();
    backfill.leave_world();
    atlas.forget_place_matches();
  }

  int last_number_ = 0;
};

}  // namespace sslam
