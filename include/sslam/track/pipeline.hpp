// SPDX-License-Identifier: BSD-3-Clause
// The pipeline: one frame in, one pose out. Its stages are policies and public members, so that tuning one is
// `pipeline.rotation.options.cone = ...` and replacing one is a template argument.
#pragma once

#include <utility>

#include "sslam/track/pose_tracking.hpp"
#include "sslam/track/upkeep/immediate_upkeep.hpp"
#include "sslam/track/worlds/atlas.hpp"
#include "sslam/track/worlds/backfill.hpp"

namespace sslam {

template <Scalar S, RotationStage<S> Rotation, InitialisationStage<S> Initialisation,
          TranslationStage<S> Translation, FallbackStage<S> Fallback, RefinementStage<S> Refinement,
          KeyframeStage<S> Keyframes, MappingStage<S> Mapping, LoopStage<S> Loops = NoLoopClosing<S>,
          StageTimer Timer = NoTimer, UpkeepStage<S, Mapping, Loops> Upkeep = ImmediateUpkeep<S>>
class Pipeline : public PoseTracking<S, Rotation, Translation, Fallback, Refinement, Timer> {
  using Tracking = PoseTracking<S, Rotation, Translation, Fallback, Refinement, Timer>;

 public:
  using Tracking::fallback, Tracking::refinement, Tracking::rotation, Tracking::translation;
  using Tracking::motion, Tracking::relocalisation, Tracking::timer;
  Initialisation initialisation;
  Keyframes keyframes;
  Mapping mapping;
  Loops loops;
  Backfill<S> backfill;
  MapTrial<S> trial;
  Atlas<S> atlas;
  Upkeep upkeep;  // after the stages that it may still be at work with when the pipeline ends

  // Takes the frame's buffers over and leaves it those of an earlier frame to fill again.
  TrackResult<S> track(Frame<S>& frame) {
    timer.begin();
    TrackResult<S> result;
    result.loop_closed = follow_map(upkeep.renew(world_.map));
    frames_.begin(frame);
    result.index = frames_.current().frame.index;
    result.stamp = frames_.current().frame.stamp;
    if (!world_.map.empty())
      follow(result);
    else if (!revisit(result))
      initialise(result);
    if (world_.map.empty() || trial.undecided(world_.map) || trial.lost())
      backfill.keep(frames_.current(), result.has_pose());
    else
      backfill.clear();
    result.world = world_.number;
    return result;
  }

  // Goes on in a map that was made earlier: the next frames are lost until one is recognised.
  void resume(Map<S> map) {
    start_over(std::move(map));
    world_.cursor.move_to(0);  // never removed
    trial.begin_in_given_map();
  }

  // Takes what mapping elsewhere has still to say, and waits for it; true if that closed a loop. Of several
  // worlds, the map and the trajectory are then those of the one in which most frames were tracked. The next
  // frame, if there is one, goes on from there.
  bool finish() {
    const bool loop_closed = follow_map(upkeep.finish(world_.map));
    World<S>* largest = atlas.largest();
    if (largest != nullptr && Atlas<S>::smaller(world_, *largest)) change_places(*largest);
    return loop_closed;
  }

  // Of the world that the camera is in, or was in last.
  [[nodiscard]] const Map<S>& map() const noexcept { return world_.map; }
  [[nodiscard]] const TrajectoryLog<S>& trajectory() const noexcept { return world_.log; }
  [[nodiscard]] int world() const noexcept { return world_.number; }
  [[nodiscard]] const TrackedFrame<S>& last_frame() const noexcept { return frames_.current(); }

 private:
  void initialise(TrackResult<S>& result) {
    TrackedFrame<S>& frame = frames_.current();
    result.state = State::kInitialising;
    const SO3<S> predicted = frames_.last().cam_from_world.rotation;
    const RotationAnswer<S> answer = Tracking::rotate(predicted, world_.map, frame, result);
    const SO3<S>& rotation_now = answer.trusted ? frame.manhattan->cam_from_world : predicted;
    frame.cam_from_world = {rotation_now, Vec3<S>::Zero()};
    result.reason = initialisation.start(frame, world_.map);
    timer.end(Stage::kInitialisation);
    if (result.reason != Reason::kFine) return;
    mapping.begin(world_.map, frame, world_.cursor.scene_depth(world_.map, frame));
    timer.end(Stage::kMapping);
    for (const Keyframe<S>& kf : world_.map.keyframes)
      world_.log.add(world_.map, kf.frame.index, kf.frame.stamp, kf.id, kf.cam_from_world);
    world_.cursor.move_to(world_.map.keyframes.back().id);
    backfill.run(world_.map, fallback, refinement, keyframes, mapping, world_.log);
    frame.read_back(reference());
    result.state = answer.trusted ? State::kManhattan : State::kFallback;
    result.cam_from_world = frame.cam_from_world;
    result.point_inliers = count_held(frame.point_landmarks);
    result.line_inliers = count_held(frame.line_landmarks);
    result.keyframe = true;
    motion.stop();
    motion.update(frame.cam_from_world, result.stamp);
  }

  void follow(TrackResult<S>& result) {
    const bool lost = trial.lost();
    PoseEstimate<S> estimate;
    if (!lost || motion.reaches(result.stamp)) estimate = Tracking::track_pose(world_, frames_, result);
    const bool tracked = estimate.ok();
    if (!tracked && lost) estimate = Tracking::recognise(world_, rotation, trial, frames_.current(), result);
    if (estimate.ok()) return settle(estimate, tracked, result);
    if (!lost || !revisit(result)) lose(result, estimate.reason);
  }

  // The frame has its place; if it was not tracked there, then it has been found.
  void settle(const PoseEstimate<S>& estimate, bool tracked, TrackResult<S>& result) {
    TrackedFrame<S>& frame = frames_.current();
    Map<S>& map = world_.map;
    trial.weigh(frame);
    if (trial.refutes(map)) return lose(result, Reason::kManhattanRejected);
    result.point_inliers = estimate.point_inliers;
    result.line_inliers = estimate.line_inliers;
    result.cam_from_world = frame.cam_from_world;
    trial.end_loss();
    if (!tracked) {
      motion.stop();
      result.state = State::kFallback;
      result.reason = Reason::kRelocalised;
    }
    result.keyframe = world_.cursor.advance(map, frame, estimate, keyframes, [&](S depth) {
      return upkeep.insert(map, frame, world_.cursor.reference(), depth, mapping, loops);
    });
    motion.update(frame.cam_from_world, result.stamp);
    if (result.keyframe) {
      timer.end(Stage::kMapping);
      close_loop(result);
      meet_known(result);
      timer.end(Stage::kLoops);
    }
    world_.log.add(map, result.index, result.stamp, world_.cursor.reference(), frame.cam_from_world);
    if (!tracked)
      backfill.run_back(world_.map, fallback, refinement, frame, world_.cursor.reference(), world_.log);
  }

  // The frame has just become a keyframe; the world may move under it.
  void close_loop(TrackResult<S>& result) {
    TrackedFrame<S>& frame = frames_.current();
    const LoopAnswer<S> answer = upkeep.close(world_.map, world_.cursor.reference(), loops);
    if (answer.closed) {
      result.loop_closed = true;
      frame.read_back(reference());
      if (!answer.new_from_old.empty()) world_.log.follow([&](KeyframeId id) { return answer.scale_at(id); });
      motion.move_to(frame.cam_from_world, answer.scale_at(world_.cursor.reference()));
    }
  }

  // The frame has just become a keyframe; it may show a place of a world that was left.
  void meet_known(TrackResult<S>& result) {
    World<S>* known = atlas.met_by(world_.map, world_.cursor.reference(), detection_);
    if (known == nullptr) return;
    follow_map(upkeep.finish(world_.map));  // the maps are joined as they are now
    if (const auto place = detection_.find(world_.map, world_.cursor.reference(), known->map))
      join(atlas.take(*known), *place, result);
  }

  [[nodiscard]] const Keyframe<S>& reference() const {
    return world_.map.keyframes[world_.map.index(world_.cursor.reference())];
  }

  void join(World<S> known, const Loop<S>& place, TrackResult<S>& result) {
    const MapJoint<S> joint = known.take_in(std::move(world_), place, loops);
    world_ = std::move(known);
    for (TrackedFrame<S>& frame : frames_.all()) {
      joint.shift.apply_to_matches(frame);
      frame.cam_from_world = carried(joint.moved, frame.cam_from_world);
    }
    TrackedFrame<S>& frame = frames_.current();
    frame.read_back(reference());
    motion.move_to(frame.cam_from_world, joint.moved.scale);
    rotation.reset(world_.map.world_from_manhattan);
    trial = world_.trial;
    trial.end_loss();
    atlas.forget_place_matches();
    result.maps_joined = true;
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

  // The camera may be back in a world that was left; one of them is asked for each frame.
  bool revisit(TrackResult<S>& result) {
    World<S>* known = atlas.next();
    if (known == nullptr) return false;
    TrackedFrame<S>& frame = frames_.current();
    Rotation elsewhere = rotation;
    elsewhere.reset(known->map.world_from_manhattan);
    const PoseEstimate<S> estimate = Tracking::recognise(*known, elsewhere, trial, frame, result);
    if (!estimate.ok()) {
      frame.forget_matches();
      frame.forget_manhattan();
      return false;
    }
    change_places(*known);
    if (trial.young(known->map)) (void)atlas.take(*known);
    world_.cursor.move_to(world_.cursor.reference());
    settle(estimate, false, result);
    return true;
  }

  void lose(TrackResult<S>& result, Reason reason) {
    result.state = State::kLost;
    result.reason = reason;
    frames_.lose();
    rotation.lose();
    trial.add_lost(frames_.current().frame);
    if (trial.refutes(world_.map)) {
      begin_anew();
    } else if (trial.leaves() && atlas.most > 0) {
      leave_world();
      atlas.lay_aside(std::move(world_));
      begin_anew();
    }
  }

  void begin_anew() {
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

  // What mapping elsewhere has still to say comes in, and nothing after that.
  void leave_world() {
    if (const MapChange<S>* change = upkeep.finish(world_.map)) world_.follow(*change);
    upkeep.forget();
    world_.trial = trial;
    detection_ = loops.detection;
  }

  // The current frame is in the other world, and what was the world until now is laid aside for it.
  void change_places(World<S>& other) {
    leave_world();
    std::swap(world_, other);
    trial = world_.trial;
    frames_.change_world();
    enter_world();
  }

  // The world is another one: what the stages remember was of that before it.
  void enter_world() {
    rotation.reset(world_.map.world_from_manhattan);
    initialisation.reset();
    loops.forget();
    motion.stop();
    backfill.leave_world();
    atlas.forget_place_matches();
  }

  World<S> world_;
  int last_number_ = 0;
  decltype(Loops::detection) detection_;  // for worlds that were left; `loops` may be at work elsewhere
  FrameHistory<S> frames_;
};

}  // namespace sslam
