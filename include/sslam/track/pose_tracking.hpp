// SPDX-License-Identifier: BSD-3-Clause
// How a frame gets its pose in a map: first the rotation and with it the translation, where that does not
// hold all six degrees of freedom, and after a loss those of a place that looks like it.
#pragma once

#include <optional>

#include "sslam/track/contract/concepts.hpp"
#include "sslam/track/localise/frame_history.hpp"
#include "sslam/track/localise/manhattan_stance.hpp"
#include "sslam/track/localise/motion_model.hpp"
#include "sslam/track/localise/normal_demand.hpp"
#include "sslam/track/localise/normal_trust.hpp"
#include "sslam/track/localise/pose_certainty.hpp"
#include "sslam/track/localise/relocalisation.hpp"
#include "sslam/track/localise/rotation_evidence.hpp"
#include "sslam/track/worlds/world.hpp"

namespace sslam {

// The part of the pipeline that changes nothing of the map but its Manhattan frames and its landmarks'
// counts.
template <Scalar S, StageSet<S> Stages>
class PoseTracking {
 public:
  typename Stages::Rotation rotation;
  RotationEvidence<S> evidence;
  NormalDemand<S> demand;
  NormalTrust<S> trust;
  ManhattanStance<S> stance;
  typename Stages::Translation translation;
  typename Stages::Fallback fallback;
  typename Stages::Refinement refinement;
  PoseCertainty<S> certainty;
  ConstantVelocity<S> motion;
  Relocalisation<S> relocalisation;
  typename Stages::Timer timer;

 protected:
  RotationAnswer<S> rotate(const SO3<S>& predicted, Map<S>& map, TrackedFrame<S>& frame,
                           TrackResult<S>& result) {
    return rotate_by(rotation, predicted, map, frame, result);
  }

  // What the normals of a frame could do for its rotation, of which its lines alone say what they can.
  [[nodiscard]] NormalNeed need(const Frame<S>& frame, const SO3<S>& predicted, const Map<S>& map) {
    if (map.world_from_manhattan.empty()) return NormalNeed::kNoManhattanFrame;
    trial_rotation_ = rotation;
    return demand.need(trial_rotation_.rotate(frame, predicted, {map.world_from_manhattan, !map.empty()}));
  }

  // The current frame, from those before it.
  PoseEstimate<S> track_pose(World<S>& world, FrameHistory<S>& frames, TrackResult<S>& result) {
    recent_.gather(frames.last(), frames.before_last());
    TrackedFrame<S>& frame = frames.current();
    const SE3<S> predicted = motion.predict(result.stamp);
    const RotationAnswer<S> answer = rotate(predicted.rotation, world.map, frame, result);
    std::optional<RotationPrior<S>> prior;
    if (frame.manhattan) prior = evidence.prior(*frame.manhattan);
    PoseEstimate<S> estimate;
    result.state = State::kManhattan;
    if (answer.trusted() && evidence.rigid(*frame.manhattan))
      estimate = track_decoupled(predicted, *prior, world.map, frame);
    if (!estimate.ok()) {
      result.state = State::kFallback;
      frame.cam_from_world = predicted;
      estimate = track_features(prior ? &*prior : nullptr, world, frames);
    }
    const SO3<S>& solved = frame.cam_from_world.rotation;
    result.structure = estimate.ok() && prior && evidence.holds(*prior, solved);
    result.reason = !prior             ? Reason::kNoManhattanFrame
                    : result.structure ? Reason::kFine
                                       : Reason::kManhattanRejected;
    if (estimate.ok() && prior && certainty.certain(estimate)) {
      evidence.learn(result.index, frame.manhattan_frame, answer.seen->rotation, solved);
      if (frame.manhattan_frame < world.map.world_from_manhattan.size())
        trust.learn(answer.normal_axes, solved * world.map.world_from_manhattan[frame.manhattan_frame]);
      stance.refine(world.map, frame);
    }
    return estimate;
  }

  // The frame's place in a world, if it is found there; the world's cursor then refers to it. Where the
  // Manhattan frame is seen, the pose must agree with it: a place that only looks the same is rarely seen
  // from a direction that fits.
  PoseEstimate<S> recognise(World<S>& world, typename Stages::Rotation& rotation_there,
                            const MapTrial<S>& trial, TrackedFrame<S>& frame, TrackResult<S>& result) {
    KeyframeId place = world.cursor.reference();
    const auto agrees = [&] {
      timer.end(Stage::kFallback);
      rotate_by(rotation_there, frame.cam_from_world.rotation, world.map, frame, result);
      return !trial.contradicts(frame);
    };
    const PoseEstimate<S> estimate =
        relocalisation.find(world.map, fallback, refinement, agrees, frame, place);
    world.cursor.refer_to(place);
    timer.end(Stage::kFallback);
    return estimate;
  }

 private:
  RotationAnswer<S> rotate_by(typename Stages::Rotation& stage, const SO3<S>& predicted, Map<S>& map,
                              TrackedFrame<S>& frame, TrackResult<S>& result) {
    NormalField& normals = frame.frame.normals;
    normals.plane_sigma = static_cast<float>(trust.plane_sigma(static_cast<S>(normals.plane_sigma)));
    const RotationAnswer<S> answer =
        stage.rotate(frame.frame, predicted, {map.world_from_manhattan, !map.empty()});
    if (answer.discovered) map.world_from_manhattan.push_back(*answer.discovered);
    frame.take(answer, map.world_from_manhattan);
    if (frame.manhattan) frame.manhattan = evidence.weigh(*frame.manhattan);
    result.axes_seen = answer.axes_seen;
    timer.end(Stage::kRotation);
    return answer;
  }

  // The camera where motion leads, turned as the Manhattan frame says; the translation is solved for.
  PoseEstimate<S> track_decoupled(const SE3<S>& predicted, const RotationPrior<S>& prior, Map<S>& map,
                                  TrackedFrame<S>& frame) {
    const Vec3<S> centre = predicted.inverse().translation;
    const SO3<S>& turned = prior.cam_from_world;
    frame.cam_from_world = {turned, -(turned * centre)};
    const PoseEstimate<S> estimate = translation.translate(map, recent_, frame);
    timer.end(Stage::kTranslation);
    return estimate.ok() ? refine(map, &prior, frame) : estimate;
  }

  PoseEstimate<S> track_features(const RotationPrior<S>* prior, World<S>& world, FrameHistory<S>& frames) {
    TrackedFrame<S>& frame = frames.current();
    PoseEstimate<S> estimate = fallback.track(world.map, recent_, prior, frame);
    if (!estimate.ok()) {
      frame.cam_from_world = frames.last().cam_from_world;
      estimate = fallback.track_keyframe(world.map, world.cursor.reference(), prior, frame);
    }
    timer.end(Stage::kFallback);
    return estimate.ok() ? refine(world.map, prior, frame) : estimate;
  }

  PoseEstimate<S> refine(Map<S>& map, const RotationPrior<S>* prior, TrackedFrame<S>& frame) {
    const PoseEstimate<S> estimate = refinement.refine(map, prior, frame);
    timer.end(Stage::kRefinement);
    return estimate;
  }

  RecentLandmarks<S> recent_;
  typename Stages::Rotation trial_rotation_;  // a copy, whose answers leave no trace
};

}  // namespace sslam
