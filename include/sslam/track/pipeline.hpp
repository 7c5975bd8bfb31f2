// SPDX-License-Identifier: BSD-3-Clause
// The pipeline: one frame in, one pose out. Its stages are public members, so that tuning one is
// `pipeline.rotation.options.max_sigma = ...`; presets.hpp shows how one is replaced.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "sslam/track/matching/image_fixed_features.hpp"
#include "sslam/track/world_keeping.hpp"

namespace sslam {

template <Scalar S, StageSet<S> StageTypes>
class Pipeline : public WorldKeeping<S, StageTypes> {
  using Worlds = WorldKeeping<S, StageTypes>;

 public:
  using ScalarType = S;
  using Stages = StageTypes;
  using Worlds::atlas, Worlds::backfill, Worlds::final_pass, Worlds::trial;
  using Worlds::certainty, Worlds::fallback, Worlds::refinement, Worlds::rotation, Worlds::stance;
  using Worlds::demand, Worlds::evidence, Worlds::trust, Worlds::motion, Worlds::relocalisation,
      Worlds::timer;
  using Worlds::initialisation, Worlds::keyframes, Worlds::loops, Worlds::mapping, Worlds::upkeep;
  using Worlds::last_number, Worlds::worlds;
  using Worlds::translation;

  ImageFixedFeatures<S> image_fixed;
  bool localise_only = false;  // no keyframe is made, and no map begun, given up, left or joined
  bool keep_frames = false;    // frames are kept for a final pass, when finish() is called

  // Why the normals of a frame that has none yet could change its pose. Asked before the frame is tracked,
  // and changes nothing: without normals it is tracked by its lines. A frame that the map holds has its
  // rotation from there, and one that is lost is looked for by its features.
  [[nodiscard]] NormalNeed normal_need(const Frame<S>& frame) {
    const TrackedFrame<S>& last = frames_.current();
    if (world_.map.empty()) return Worlds::need(frame, last.cam_from_world.rotation, world_.map);
    if (trial.lost() && !motion.reaches(frame.stamp)) return NormalNeed::kNotNeeded;
    const int held_by = count_held(last.point_landmarks) + count_held(last.line_landmarks);
    if (!trial.lost() && held_by >= demand.options.held_by) return NormalNeed::kNotNeeded;
    return Worlds::need(frame, motion.predict(frame.stamp).rotation, world_.map);
  }

  // Takes the frame's buffers over and leaves it those of an earlier frame to fill again.
  TrackResult<S> track(Frame<S>& frame) {
    timer.begin();
    TrackResult<S> result;
    result.loop_closed = follow_map(upkeep.renew(world_.map));
    leave_out_fixed(frame, result);
    frames_.begin(frame);
    result.index = frames_.current().frame.index;
    result.stamp = frames_.current().frame.stamp;
    step_ = last_stamp_ ? std::clamp(result.stamp - *last_stamp_, 0.0, kLongestStep) : 0;
    last_stamp_ = result.stamp;
    if (!world_.map.empty())
      follow(result);
    else if (!revisit(result) && !localise_only)
      initialise(result);
    if (world_.map.empty() || trial.undecided(world_.map) || trial.lost())
      backfill.keep(frames_.current(), result.has_pose());
    else
      backfill.clear();
    if (keep_frames && !localise_only) final_pass.keep(frames_.current());
    result.world = world_.number;
    return result;
  }

  // Goes on in a map that was made earlier: the next frames are lost until one is recognised.
  void resume(Map<S> map) {
    Worlds::start_over(std::move(map));
    world_.cursor.move_to(0, world_.map.keyframes.front().frame.stamp);  // never removed
    trial.begin_in_given_map();
  }

  // Goes on where another pipeline stood, with the maps and logs of its worlds, the camera's first. What the
  // stages had learned of the images is learned anew, and the next frames are lost until one is recognised.
  void go_on(std::vector<World<S>> known, int begun_last) {
    Worlds::take_over(std::move(known), begun_last);
    many_fixed_ = !world_.map.empty();  // a map that has lasted is not given up for them
    if (!world_.map.empty()) trial.add_lost(Frame<S>(), 0);
  }

  // Takes what mapping elsewhere has still to say, and waits for it; true if a loop was closed by that, or by
  // the final pass. Of several worlds, the map and the trajectory are then those of the one in which most
  // frames were tracked. The next frame, if there is one, goes on from there.
  bool finish() {
    bool loop_closed = follow_map(upkeep.finish(world_.map));
    World<S>* largest = atlas.largest();
    if (largest != nullptr && Atlas<S>::smaller(world_, *largest)) Worlds::change_places(*largest);
    if (keep_frames && !localise_only) loop_closed = Worlds::prepare_final_pass() || loop_closed;
    final_pass.run(world_.map, *this, world_.log);
    return loop_closed;
  }

  // Of the world that the camera is in, or was in last.
  [[nodiscard]] const Map<S>& map() const noexcept { return world_.map; }
  [[nodiscard]] const TrajectoryLog<S>& trajectory() const noexcept { return world_.log; }
  [[nodiscard]] int world() const noexcept { return world_.number; }
  [[nodiscard]] const TrackedFrame<S>& last_frame() const noexcept { return frames_.current(); }

 private:
  static constexpr double kLongestStep = 0.25;  // seconds that a frame stands for: a pause is no evidence

  using Worlds::drifted_, Worlds::finder_, Worlds::frames_, Worlds::world_;
  using Worlds::follow_map, Worlds::reference;

  // A map that was begun before many features were found to be fixed to the image holds them, and is given
  // up.
  void leave_out_fixed(Frame<S>& frame, TrackResult<S>& result) {
    const std::size_t seen = frame.points.size() + frame.lines.size();
    const std::size_t left_out = image_fixed.leave_out(frame, world_.map.empty());
    result.image_fixed = static_cast<int>(left_out);
    const bool many = 5 * left_out > seen;
    if (!many || std::exchange(many_fixed_, true) || world_.map.empty() || localise_only) return;
    Worlds::give_up_world(false);
  }

  void initialise(TrackResult<S>& result) {
    TrackedFrame<S>& frame = frames_.current();
    result.state = State::kInitialising;
    const SO3<S> predicted = frames_.last().cam_from_world.rotation;
    const RotationAnswer<S> answer = Worlds::rotate(predicted, world_.map, frame, result);
    const SO3<S>& rotation_now = answer.trusted() ? answer.seen->rotation.cam_from_world : predicted;
    frame.cam_from_world = {rotation_now, Vec3<S>::Zero()};
    result.reason = initialisation.start(frame, world_.map);
    timer.end(Stage::kInitialisation);
    if (result.reason != Reason::kFine) return;
    mapping.begin(world_.map, frame, world_.cursor.scene_depth(world_.map, frame));
    timer.end(Stage::kMapping);
    for (const Keyframe<S>& kf : world_.map.keyframes)
      world_.log.add(world_.map, kf.frame.index, kf.frame.stamp, kf.id, kf.cam_from_world);
    world_.cursor.move_to(world_.map.keyframes.back().id, frame.frame.stamp);
    backfill.run(world_.map, fallback, refinement, certainty, keyframes, mapping, world_.log);
    frame.read_back(reference());
    result.state = answer.trusted() ? State::kManhattan : State::kFallback;
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
    if (!lost || motion.reaches(result.stamp)) estimate = Worlds::track_pose(world_, frames_, result);
    if (estimate.ok() && !localise_only && !trial.believes(frames_.current()))
      estimate.reason = Reason::kManhattanRejected;
    const bool tracked = estimate.ok();
    if (!tracked && lost) estimate = Worlds::recognise(world_, rotation, trial, frames_.current(), result);
    if (estimate.ok()) return settle(estimate, tracked, result);
    if (!lost || !revisit(result)) lose(result, estimate.reason);
  }

  // The frame has its place; if it was not tracked there, then it has been found. Of an uncertain pose
  // nothing is built or learned.
  void settle(const PoseEstimate<S>& estimate, bool tracked, TrackResult<S>& result) {
    TrackedFrame<S>& frame = frames_.current();
    Map<S>& map = world_.map;
    const bool certain = certainty.certain(estimate);
    if (!tracked) trial.drift.end();
    if (certain) trial.weigh(frame, result.structure, estimate.point_inliers + estimate.line_inliers, step_);
    if (!localise_only && (trial.refutes(map) || !trial.believes(frame)))
      return lose(result, Reason::kManhattanRejected);
    result.point_inliers = estimate.point_inliers;
    result.line_inliers = estimate.line_inliers;
    result.cam_from_world = frame.cam_from_world;
    result.covariance = estimate.covariance;
    trial.end_loss();
    if (!tracked) {
      motion.stop();
      result.state = State::kFallback;
      result.reason = Reason::kRelocalised;
    }
    if (!certain) result.state = State::kUncertain;
    result.keyframe =
        certain && !localise_only && world_.cursor.advance(map, frame, estimate, keyframes, [&](S depth) {
          return upkeep.insert(map, frame, world_.cursor.reference(), depth, mapping, loops);
        });
    motion.update(frame.cam_from_world, result.stamp);
    if (result.keyframe) {
      timer.end(Stage::kMapping);
      result.loop_closed = Worlds::close_loop() || result.loop_closed;
      meet_known(result);
      timer.end(Stage::kLoops);
    }
    world_.log.add(map, result.index, result.stamp, world_.cursor.reference(), frame.cam_from_world);
    if (!tracked)
      backfill.run_back(world_.map, fallback, refinement, frame, world_.cursor.reference(), world_.log);
  }

  // The frame has just become a keyframe; it may show a place of a world that was left.
  void meet_known(TrackResult<S>& result) {
    World<S>* known = atlas.met_by(world_.map, world_.cursor.reference(), finder_);
    if (known == nullptr) return;
    follow_map(upkeep.finish(world_.map));  // the maps are joined as they are now
    if (const auto place = finder_.find(world_.map, world_.cursor.reference(), known->map)) {
      Worlds::join(atlas.take(*known), *place);
      result.maps_joined = true;
    }
  }

  // The camera may be back in a world that was left; one of them is asked for each frame.
  bool revisit(TrackResult<S>& result) {
    World<S>* known = atlas.next();
    if (known == nullptr) return false;
    TrackedFrame<S>& frame = frames_.current();
    auto elsewhere = rotation;
    elsewhere.forget();
    const PoseEstimate<S> estimate = Worlds::recognise(*known, elsewhere, trial, frame, result);
    if (!estimate.ok()) {
      frame.forget_matches();
      frame.forget_manhattan();
      return false;
    }
    Worlds::change_places(*known);
    if (trial.young(known->map)) (void)atlas.take(*known);
    world_.cursor.move_to(world_.cursor.reference(), frame.frame.stamp);
    settle(estimate, false, result);
    return true;
  }

  void lose(TrackResult<S>& result, Reason reason) {
    result.state = State::kLost;
    result.reason = reason;
    result.structure = false;
    frames_.lose();
    rotation.lose();
    if (keep_frames && !final_pass.full() && !trial.lost() && trial.drift.drifted())
      drifted_.add(trial.drift.began_after(), result.stamp);
    trial.add_lost(frames_.current().frame, step_);
    if (localise_only) return;
    const bool left = trial.leaves() && atlas.options.most > 0;
    const bool refuted = trial.refutes(world_.map);
    if (refuted || left) Worlds::give_up_world(!refuted);
  }

  std::optional<double> last_stamp_;
  bool many_fixed_ = false;  // a fifth of a frame's features have been left out, once at least
  double step_ = 0;          // seconds since the frame before this one
};

}  // namespace sslam
