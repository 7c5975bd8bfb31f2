// SPDX-License-Identifier: BSD-3-Clause
// The pipeline: one frame in, one pose out. Its stages are policies and public members, so that tuning one is
// `pipeline.rotation.options.cone = ...` and replacing one is a template argument.
#pragma once

#include <optional>
#include <utility>

#include "sslam/track/backfill.hpp"
#include "sslam/track/concepts.hpp"
#include "sslam/track/keyframe_cursor.hpp"
#include "sslam/track/motion_model.hpp"
#include "sslam/track/relocalisation.hpp"
#include "sslam/track/stage_timer.hpp"
#include "sslam/track/tracking_loss.hpp"
#include "sslam/track/trajectory_log.hpp"
#include "sslam/track/upkeep.hpp"

namespace sslam {

template <Scalar S, RotationStage<S> Rotation, InitialisationStage<S> Initialisation,
          TranslationStage<S> Translation, FallbackStage<S> Fallback, RefinementStage<S> Refinement,
          KeyframeStage<S> Keyframes, MappingStage<S> Mapping, LoopStage<S> Loops = NoLoopClosing<S>,
          StageTimer Timer = NoTimer, UpkeepStage<S, Mapping, Loops> Upkeep = ImmediateUpkeep<S>>
class Pipeline {
 public:
  Pipeline() = default;
  Pipeline(const Pipeline&) = delete;  // the frames in hand point into it
  Pipeline& operator=(const Pipeline&) = delete;

  Rotation rotation;
  Initialisation initialisation;
  Translation translation;
  Fallback fallback;
  Refinement refinement;
  Keyframes keyframes;
  Mapping mapping;
  Loops loops;
  Backfill<S> backfill;
  TrackingLoss<S> loss;
  Relocalisation<S> relocalisation;
  Timer timer;
  Upkeep upkeep;  // after the stages that it may still be at work with when the pipeline ends

  // Takes the frame's buffers over and leaves it those of an earlier frame to fill again.
  TrackResult<S> track(Frame<S>& frame) {
    timer.begin();
    TrackResult<S> result;
    result.loop_closed = follow_map(upkeep.renew(map_));
    rotate_buffers();
    current_->adopt(frame);
    result.index = current_->frame.index;
    result.stamp = current_->frame.stamp;
    if (map_.empty())
      initialise(result);
    else
      follow(result);
    if (map_.empty() || loss.undecided(map_))
      backfill.keep(*current_);
    else
      backfill.clear();
    return result;
  }

  // Goes on in a map that was made earlier: the next frames are lost until one is recognised.
  void resume(Map<S> map) {
    start_over(std::move(map));
    cursor_.move_to(0);  // never removed
    loss.begin_in_given_map();
  }

  // Takes what mapping elsewhere has still to say, and waits for it; true if that closed a loop. The next
  // frame, if there is one, goes on from there.
  bool finish() { return follow_map(upkeep.finish(map_)); }

  [[nodiscard]] const Map<S>& map() const noexcept { return map_; }
  [[nodiscard]] const TrajectoryLog<S>& trajectory() const noexcept { return log_; }
  [[nodiscard]] const TrackedFrame<S>& last_frame() const noexcept { return *current_; }

 private:
  void rotate_buffers() noexcept {
    TrackedFrame<S>* const oldest = before_;
    before_ = last_;
    last_ = current_;
    current_ = oldest;
  }

  void initialise(TrackResult<S>& result) {
    result.state = State::kInitialising;
    const SO3<S> predicted = last_->cam_from_world.rotation;
    const RotationAnswer<S> answer = rotate(predicted, result);
    const SO3<S>& rotation_now = answer.trusted ? current_->manhattan->cam_from_world : predicted;
    current_->cam_from_world = {rotation_now, Vec3<S>::Zero()};
    result.reason = initialisation.start(*current_, map_);
    timer.end(Stage::kInitialisation);
    if (result.reason != Reason::kFine) return;
    mapping.begin(map_, *current_, cursor_.scene_depth(map_, *current_));
    timer.end(Stage::kMapping);
    for (const Keyframe<S>& kf : map_.keyframes)
      log_.add(map_, kf.frame.index, kf.frame.stamp, kf.id, kf.cam_from_world);
    cursor_.move_to(map_.keyframes.back().id);
    backfill.run(map_, fallback, refinement, keyframes, mapping, log_);
    current_->read_back(map_.keyframes[map_.index(cursor_.reference())]);
    report(result, answer.trusted ? State::kManhattan : State::kFallback);
    result.keyframe = true;
    motion_.stop();
    motion_.update(current_->cam_from_world, result.stamp);
  }

  void follow(TrackResult<S>& result) {
    recent_.gather(*last_, *before_);
    const PoseEstimate<S> estimate = loss.lasts() ? relocalise(result) : track_pose(result);
    if (!estimate.ok()) return lose(result, estimate.reason);
    loss.weigh(*current_);
    if (loss.refutes(map_)) return lose(result, Reason::kManhattanRejected);
    result.point_inliers = estimate.point_inliers;
    result.line_inliers = estimate.line_inliers;
    result.cam_from_world = current_->cam_from_world;
    if (loss.lasts()) {
      motion_.stop();
      loss.end();
      result.reason = Reason::kRelocalised;
    }
    result.keyframe = cursor_.advance(map_, *current_, estimate, keyframes, [&](S depth) {
      return upkeep.insert(map_, *current_, cursor_.reference(), depth, mapping, loops);
    });
    motion_.update(current_->cam_from_world, result.stamp);
    if (result.keyframe) {
      timer.end(Stage::kMapping);
      close_loop(result);
    }
    log_.add(map_, result.index, result.stamp, cursor_.reference(), current_->cam_from_world);
  }

  // The frame has just become a keyframe; the world may move under it.
  void close_loop(TrackResult<S>& result) {
    const LoopAnswer<S> answer = upkeep.close(map_, cursor_.reference(), loops);
    if (answer.closed) {
      result.loop_closed = true;
      current_->read_back(map_.keyframes[map_.index(cursor_.reference())]);
      if (!answer.new_from_old.empty()) log_.follow([&](KeyframeId id) { return answer.scale_at(id); });
      motion_.move_to(current_->cam_from_world, answer.scale_at(cursor_.reference()));
    }
    timer.end(Stage::kLoops);
  }

  // The map has changed under the frames in hand; true if a loop was closed.
  bool follow_map(const MapChange<S>* change) {
    if (change == nullptr) return false;
    const KeyframeId reference = cursor_.reference();
    for (TrackedFrame<S>* const frame : {current_, last_}) change->carry(reference, *frame);
    motion_.move_to(current_->cam_from_world, change->scale_at(reference));
    cursor_.refer_to(map_.carrier(reference));
    if (change->loop_closed) log_.follow([&](KeyframeId id) { return change->scale_at(id); });
    return change->loop_closed;
  }

  RotationAnswer<S> rotate(const SO3<S>& predicted, TrackResult<S>& result) {
    const RotationAnswer<S> answer = rotation.rotate(*current_, predicted, !map_.empty());
    map_.world_from_manhattan = rotation.world_from_manhattan();
    result.axes_seen = answer.axes_seen;
    timer.end(Stage::kRotation);
    return answer;
  }

  // The decoupled way first; where it does not hold, six degrees of freedom.
  PoseEstimate<S> track_pose(TrackResult<S>& result) {
    const SE3<S> predicted = motion_.predict(result.stamp);
    const RotationAnswer<S> answer = rotate(predicted.rotation, result);
    std::optional<RotationPrior<S>> prior;
    if (current_->manhattan) prior = make_prior(*current_->manhattan);
    result.reason = Reason::kNoManhattanFrame;
    if (answer.trusted) {
      const Vec3<S> centre = predicted.inverse().translation;
      const SO3<S>& turned = current_->manhattan->cam_from_world;
      current_->cam_from_world = {turned, -(turned * centre)};
      PoseEstimate<S> estimate = translation.translate(map_, recent_, *current_);
      timer.end(Stage::kTranslation);
      if (estimate.ok()) {
        estimate = refinement.refine(map_, &*prior, *current_);
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
    current_->cam_from_world = predicted;
    PoseEstimate<S> estimate = fallback.track(map_, recent_, prior, *current_);
    if (!estimate.ok()) {
      current_->cam_from_world = last_->cam_from_world;
      estimate = fallback.track_keyframe(map_, cursor_.reference(), prior, *current_);
    }
    timer.end(Stage::kFallback);
    if (!estimate.ok()) return estimate;
    estimate = refinement.refine(map_, prior, *current_);
    timer.end(Stage::kRefinement);
    return estimate;
  }

  PoseEstimate<S> relocalise(TrackResult<S>& result) {
    result.state = State::kFallback;
    KeyframeId place = cursor_.reference();
    const auto agrees = [&] { return stands_square(result); };
    const PoseEstimate<S> estimate =
        relocalisation.find(map_, fallback, refinement, agrees, *current_, place);
    cursor_.refer_to(place);
    timer.end(Stage::kFallback);
    return estimate;
  }

  // Whether the pose that a lost frame was given agrees with the Manhattan frame, where that is seen: a place
  // that only looks the same is rarely seen from a direction that fits.
  bool stands_square(TrackResult<S>& result) {
    timer.end(Stage::kFallback);
    const SO3<S>& found = current_->cam_from_world.rotation;
    rotate(found, result);
    return !loss.contradicts(*current_);
  }

  void lose(TrackResult<S>& result, Reason reason) {
    result.state = State::kLost;
    result.reason = reason;
    current_->forget_matches();
    current_->cam_from_world = last_->cam_from_world;
    loss.add(current_->frame);
    if (loss.refutes(map_)) start_over({});
  }

  void start_over(Map<S> map) {
    upkeep.forget();
    map_ = std::move(map);
    log_.clear();
    rotation.reset(map_.world_from_manhattan);
    initialisation.reset();
    motion_.stop();
    loss.begin_again();
    current_->forget_manhattan();
    backfill.leave_world();
  }

  void report(TrackResult<S>& result, State state) {
    scratch_.gather(map_, *current_);
    result.state = state;
    result.cam_from_world = current_->cam_from_world;
    result.point_inliers = scratch_.point_inlier_count();
    result.line_inliers = scratch_.line_inlier_count();
  }

  static RotationPrior<S> make_prior(const RotationObservation<S>& observation) {
    return {observation.cam_from_world, observation.covariance.inverse()};
  }

  Map<S> map_;
  TrajectoryLog<S> log_;
  TrackedFrame<S> buffers_[3];
  TrackedFrame<S>* current_ = &buffers_[0];
  TrackedFrame<S>* last_ = &buffers_[1];
  TrackedFrame<S>* before_ = &buffers_[2];
  RecentLandmarks<S> recent_;
  ConstantVelocity<S> motion_;
  Correspondences<S> scratch_;
  KeyframeCursor<S> cursor_;
};

}  // namespace sslam
