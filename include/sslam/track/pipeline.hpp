// SPDX-License-Identifier: BSD-3-Clause
// The pipeline: one frame in, one pose out. Its stages are policies and public members, so that tuning one is
// `pipeline.rotation.options.cone = ...` and replacing one is a template argument.
#pragma once

#include <optional>
#include <utility>

#include "sslam/track/backfill.hpp"
#include "sslam/track/concepts.hpp"
#include "sslam/track/frame_history.hpp"
#include "sslam/track/keyframe_cursor.hpp"
#include "sslam/track/map_trial.hpp"
#include "sslam/track/motion_model.hpp"
#include "sslam/track/relocalisation.hpp"
#include "sslam/track/stage_timer.hpp"
#include "sslam/track/trajectory_log.hpp"
#include "sslam/track/upkeep.hpp"

namespace sslam {

template <Scalar S, RotationStage<S> Rotation, InitialisationStage<S> Initialisation,
          TranslationStage<S> Translation, FallbackStage<S> Fallback, RefinementStage<S> Refinement,
          KeyframeStage<S> Keyframes, MappingStage<S> Mapping, LoopStage<S> Loops = NoLoopClosing<S>,
          StageTimer Timer = NoTimer, UpkeepStage<S, Mapping, Loops> Upkeep = ImmediateUpkeep<S>>
class Pipeline {
 public:
  Rotation rotation;
  Initialisation initialisation;
  Translation translation;
  Fallback fallback;
  Refinement refinement;
  Keyframes keyframes;
  Mapping mapping;
  Loops loops;
  ConstantVelocity<S> motion;
  Backfill<S> backfill;
  MapTrial<S> trial;
  Relocalisation<S> relocalisation;
  Timer timer;
  Upkeep upkeep;  // after the stages that it may still be at work with when the pipeline ends

  // Takes the frame's buffers over and leaves it those of an earlier frame to fill again.
  TrackResult<S> track(Frame<S>& frame) {
    timer.begin();
    TrackResult<S> result;
    result.loop_closed = follow_map(upkeep.renew(map_));
    frames_.begin(frame);
    result.index = frames_.current().frame.index;
    result.stamp = frames_.current().frame.stamp;
    if (map_.empty())
      initialise(result);
    else
      follow(result);
    if (map_.empty() || trial.undecided(map_))
      backfill.keep(frames_.current());
    else
      backfill.clear();
    return result;
  }

  // Goes on in a map that was made earlier: the next frames are lost until one is recognised.
  void resume(Map<S> map) {
    start_over(std::move(map));
    cursor_.move_to(0);  // never removed
    trial.begin_in_given_map();
  }

  // Takes what mapping elsewhere has still to say, and waits for it; true if that closed a loop. The next
  // frame, if there is one, goes on from there.
  bool finish() { return follow_map(upkeep.finish(map_)); }

  [[nodiscard]] const Map<S>& map() const noexcept { return map_; }
  [[nodiscard]] const TrajectoryLog<S>& trajectory() const noexcept { return log_; }
  [[nodiscard]] const TrackedFrame<S>& last_frame() const noexcept { return frames_.current(); }

 private:
  void initialise(TrackResult<S>& result) {
    TrackedFrame<S>& frame = frames_.current();
    result.state = State::kInitialising;
    const SO3<S> predicted = frames_.last().cam_from_world.rotation;
    const RotationAnswer<S> answer = rotate(predicted, result);
    const SO3<S>& rotation_now = answer.trusted ? frame.manhattan->cam_from_world : predicted;
    frame.cam_from_world = {rotation_now, Vec3<S>::Zero()};
    result.reason = initialisation.start(frame, map_);
    timer.end(Stage::kInitialisation);
    if (result.reason != Reason::kFine) return;
    mapping.begin(map_, frame, cursor_.scene_depth(map_, frame));
    timer.end(Stage::kMapping);
    for (const Keyframe<S>& kf : map_.keyframes)
      log_.add(map_, kf.frame.index, kf.frame.stamp, kf.id, kf.cam_from_world);
    cursor_.move_to(map_.keyframes.back().id);
    backfill.run(map_, fallback, refinement, keyframes, mapping, log_);
    frame.read_back(map_.keyframes[map_.index(cursor_.reference())]);
    result.state = answer.trusted ? State::kManhattan : State::kFallback;
    result.cam_from_world = frame.cam_from_world;
    result.point_inliers = count_held(frame.point_landmarks);
    result.line_inliers = count_held(frame.line_landmarks);
    result.keyframe = true;
    motion.stop();
    motion.update(frame.cam_from_world, result.stamp);
  }

  void follow(TrackResult<S>& result) {
    TrackedFrame<S>& frame = frames_.current();
    recent_.gather(frames_.last(), frames_.before_last());
    const bool lost = trial.lost();
    PoseEstimate<S> estimate;
    if (!lost || motion.reaches(result.stamp)) estimate = track_pose(result);
    const bool tracked = estimate.ok();
    if (!tracked && lost) estimate = relocalise(result);
    if (!estimate.ok()) return lose(result, estimate.reason);
    trial.weigh(frame);
    if (trial.refutes(map_)) return lose(result, Reason::kManhattanRejected);
    result.point_inliers = estimate.point_inliers;
    result.line_inliers = estimate.line_inliers;
    result.cam_from_world = frame.cam_from_world;
    trial.end_loss();
    if (!tracked) {
      motion.stop();
      result.reason = Reason::kRelocalised;
    }
    result.keyframe = cursor_.advance(map_, frame, estimate, keyframes, [&](S depth) {
      return upkeep.insert(map_, frame, cursor_.reference(), depth, mapping, loops);
    });
    motion.update(frame.cam_from_world, result.stamp);
    if (result.keyframe) {
      timer.end(Stage::kMapping);
      close_loop(result);
    }
    log_.add(map_, result.index, result.stamp, cursor_.reference(), frame.cam_from_world);
  }

  // The frame has just become a keyframe; the world may move under it.
  void close_loop(TrackResult<S>& result) {
    TrackedFrame<S>& frame = frames_.current();
    const LoopAnswer<S> answer = upkeep.close(map_, cursor_.reference(), loops);
    if (answer.closed) {
      result.loop_closed = true;
      frame.read_back(map_.keyframes[map_.index(cursor_.reference())]);
      if (!answer.new_from_old.empty()) log_.follow([&](KeyframeId id) { return answer.scale_at(id); });
      motion.move_to(frame.cam_from_world, answer.scale_at(cursor_.reference()));
    }
    timer.end(Stage::kLoops);
  }

  // The map has changed under the frames in hand; true if a loop was closed.
  bool follow_map(const MapChange<S>* change) {
    if (change == nullptr) return false;
    const KeyframeId reference = cursor_.reference();
    for (TrackedFrame<S>& frame : frames_.all()) change->carry(reference, frame);
    motion.move_to(frames_.current().cam_from_world, change->scale_at(reference));
    cursor_.refer_to(map_.carrier(reference));
    if (change->loop_closed) log_.follow([&](KeyframeId id) { return change->scale_at(id); });
    return change->loop_closed;
  }

  RotationAnswer<S> rotate(const SO3<S>& predicted, TrackResult<S>& result) {
    const RotationAnswer<S> answer = rotation.rotate(frames_.current(), predicted, !map_.empty());
    map_.world_from_manhattan = rotation.world_from_manhattan();
    result.axes_seen = answer.axes_seen;
    timer.end(Stage::kRotation);
    return answer;
  }

  // The decoupled way first; where it does not hold, six degrees of freedom.
  PoseEstimate<S> track_pose(TrackResult<S>& result) {
    TrackedFrame<S>& frame = frames_.current();
    const SE3<S> predicted = motion.predict(result.stamp);
    const RotationAnswer<S> answer = rotate(predicted.rotation, result);
    std::optional<RotationPrior<S>> prior;
    if (frame.manhattan)
      prior = RotationPrior<S>{frame.manhattan->cam_from_world, frame.manhattan->covariance.inverse()};
    result.reason = Reason::kNoManhattanFrame;
    if (answer.trusted) {
      const Vec3<S> centre = predicted.inverse().translation;
      const SO3<S>& turned = frame.manhattan->cam_from_world;
      frame.cam_from_world = {turned, -(turned * centre)};
      PoseEstimate<S> estimate = translation.translate(map_, recent_, frame);
      timer.end(Stage::kTranslation);
      if (estimate.ok()) {
        estimate = refinement.refine(map_, &*prior, frame);
        timer.end(Stage::kRefinement);
        if (estimate.ok()) {
          result.state = State::kManhattan;
          result.reason = Reason::kFine;
          return estimate;
        }
      }
      prior.reset();  // it has just been found wanting
      result.reason = Reason::kManhattanRejected;
    }
    result.state = State::kFallback;
    return track_features(predicted, prior ? &*prior : nullptr);
  }

  PoseEstimate<S> track_features(const SE3<S>& predicted, const RotationPrior<S>* prior) {
    TrackedFrame<S>& frame = frames_.current();
    frame.cam_from_world = predicted;
    PoseEstimate<S> estimate = fallback.track(map_, recent_, prior, frame);
    if (!estimate.ok()) {
      frame.cam_from_world = frames_.last().cam_from_world;
      estimate = fallback.track_keyframe(map_, cursor_.reference(), prior, frame);
    }
    timer.end(Stage::kFallback);
    if (!estimate.ok()) return estimate;
    estimate = refinement.refine(map_, prior, frame);
    timer.end(Stage::kRefinement);
    return estimate;
  }

  PoseEstimate<S> relocalise(TrackResult<S>& result) {
    result.state = State::kFallback;
    KeyframeId place = cursor_.reference();
    const auto agrees = [&] { return stands_square(result); };
    const PoseEstimate<S> estimate =
        relocalisation.find(map_, fallback, refinement, agrees, frames_.current(), place);
    cursor_.refer_to(place);
    timer.end(Stage::kFallback);
    return estimate;
  }

  // Whether the pose that a lost frame was given agrees with the Manhattan frame, where that is seen: a place
  // that only looks the same is rarely seen from a direction that fits.
  bool stands_square(TrackResult<S>& result) {
    timer.end(Stage::kFallback);
    const SO3<S>& found = frames_.current().cam_from_world.rotation;
    rotate(found, result);
    return !trial.contradicts(frames_.current());
  }

  void lose(TrackResult<S>& result, Reason reason) {
    result.state = State::kLost;
    result.reason = reason;
    frames_.lose();
    trial.add_lost(frames_.current().frame);
    if (trial.refutes(map_)) start_over({});
  }

  void start_over(Map<S> map) {
    upkeep.forget();
    map_ = std::move(map);
    log_.clear();
    rotation.reset(map_.world_from_manhattan);
    initialisation.reset();
    motion.stop();
    trial.begin_again();
    frames_.current().forget_manhattan();
    backfill.leave_world();
  }

  Map<S> map_;
  TrajectoryLog<S> log_;
  FrameHistory<S> frames_;
  RecentLandmarks<S> recent_;
  KeyframeCursor<S> cursor_;
};

}  // namespace sslam
