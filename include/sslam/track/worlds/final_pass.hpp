// SPDX-License-Identifier: BSD-3-Clause
// The final pass, after the last frame: features that see one landmark are aligned, the whole map is adjusted
// at once, then every frame is tracked again in it. A frame keeps the errors of the young map that it was
// tracked in otherwise, and one that had no pose may get one: from its neighbours, by the place that it
// shows, or by what it adds to the map. Of a rolling shutter, whose read-out time is told or found, features
// are moved to the moment of the middle row, by the motion that the trajectory tells.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/map/feature_alignment.hpp"
#include "sslam/map/map_adjustment.hpp"
#include "sslam/map/seen_patches.hpp"
#include "sslam/track/contract/concepts.hpp"
#include "sslam/track/worlds/gap_bridge.hpp"
#include "sslam/track/worlds/map_extension.hpp"
#include "sslam/track/worlds/neighbour_tracking.hpp"
#include "sslam/track/worlds/shutter_straightening.hpp"
#include "sslam/track/worlds/trajectory_log.hpp"

namespace sslam {

template <Scalar S>
struct FinalPassOptions {
  std::size_t max_frames = 3000;  // that are kept for it, 200 kB each; those after them stay as they are
  int max_misses = 5;   // frames in a row without a pose, beyond which a sweep does not guess where it is
  double read_out = 0;  // seconds from the first row of an image to the last; 0: not told

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_frames", self.max_frames, Unit::kCount, 0, 10000000,
          "that are kept to be tracked again, 200 kB each; the others keep their poses");
    visit("max_misses", self.max_misses, Unit::kCount, 0, 1000,
          "frames in a row without a pose while those behind them get one");
    visit("read_out", self.read_out, Unit::kSeconds, 0, 0.2,
          "from the first row of an image to the last, of a rolling shutter; 0: not told");
  }
};
static_assert(Described<FinalPassOptions<double>>);

template <Scalar S>
class FinalPass {
 public:
  FinalPassOptions<S> options;
  MapAdjustment<S> adjustment;
  ShutterStraightening<S> shutter;
  FeatureAlignment<S> alignment;
  GapBridge<S> bridge;

  FinalPass() {
    adjustment.solver.options.max_iterations = 20;
    adjustment.solver.options.min_decrease = S(1e-5);
  }

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("", self.options, visit);
    visit_stage("adjustment.", self.adjustment, visit);
    visit_stage("alignment.", self.alignment, visit);
    visit_stage("", self.shutter, visit);
    visit_stage("bridge.", self.bridge, visit);
  }

  // A frame has been tracked, or lost; its features are copied, with the patches of those that see landmarks.
  void keep(const TrackedFrame<S>& tracked) {
    if (full()) return;
    const Frame<S>& frame = tracked.frame;
    Frame<S>& kept = frames_.emplace_back();
    kept.index = frame.index;
    kept.stamp = frame.stamp;
    kept.pinhole = frame.pinhole;
    kept.width = frame.width;
    kept.height = frame.height;
    kept.points = frame.points;
    kept.lines = frame.lines;
    keep_seen_patches<S>(frame.patches, tracked.point_landmarks, kept);
  }

  // No further frame is kept, so that none will be tracked again.
  [[nodiscard]] bool full() const noexcept { return frames_.size() >= options.max_frames; }

  // The map has its last keyframe from the run; the frames without a pose may add more. `stages`: the
  // pipeline's. Poses go into the log; the frames are forgotten.
  template <class Stages>
  void run(Map<S>& map, Stages& stages, TrajectoryLog<S>& log) {
    shutter.begin(options.read_out);
    if (!map.empty() && !frames_.empty()) {
      log.sort();
      if (alignment.align(map) > 0) take_from_keyframes(map, log);
      const auto track_all = [&] {
        last_.point_landmarks.clear();
        last_.line_landmarks.clear();
        previous_.reset();
        for (std::size_t i = 0; i < frames_.size(); ++i) track(i, 1, map, stages, log);
      };
      if (shutter.read_out() == 0) {
        adjustment.optimise_all(map);
        track_all();
      }
      // Each round knows the motion better by which the next one straightens.
      for (int round = 0; round < kRounds && shutter.straighten_map(frames_, log, adjustment, map); ++round)
        track_all();
      previous_.reset();
      for (std::size_t i = frames_.size(); i-- > 0;)
        if (log.find(frames_[i].index) == nullptr) track(i, -1, map, stages, log);
      find_lost(map, stages, log);
      extension_.run(
          frames_, options.max_misses,
          [&](std::size_t i, KeyframeId reference) { return straightened(i, map, reference); }, map, stages,
          log);
      bridge.run(frames_, map, log);
    }
    frames_.clear();
    previous_.reset();
  }

  // Seconds from the first row to the last by which the last run straightened, told or found; 0: it did not.
  [[nodiscard]] double read_out() const noexcept { return shutter.read_out(); }

 private:
  static constexpr int kRounds = 3;  // a fourth gains a tenth at most

  // The frame that the sweep came through last and knows a pose of.
  struct Previous {
    std::size_t position;  // in frames_
    KeyframeId reference;
    SE3<S> cam_from_world;
  };

  template <class Stages>
  void track(std::size_t i, int step, Map<S>& map, Stages& stages, TrajectoryLog<S>& log) {
    if (step < 0) look_up(i + 1, map, log);  // it may have been passed without being tracked
    if (look_up(i, map, log) && map.keyframes[map.index(previous_->reference)].made_of(frames_[i])) return;
    if (!previous_ || distance(i, previous_->position) > static_cast<std::size_t>(options.max_misses) + 1)
      return;
    const KeyframeId reference = previous_->reference;
    take_features(i, map);
    frame_.cam_from_world = previous_->cam_from_world;
    around_.read_back(map.keyframes[map.index(reference)]);
    const PoseEstimate<S> estimate = neighbours_.track(step > 0 ? last_ : around_, around_, map,
                                                       stages.fallback, stages.refinement, frame_);
    if (estimate.ok()) {
      align(map, stages.refinement);
      place(i, reference, map, log);
    }
    if (!shutter.straightens(i)) std::swap(frames_[i], frame_.frame);
  }

  // frame_ has a pose; it gets that of its features once they are aligned.
  template <class Refinement>
  void align(Map<S>& map, Refinement& refinement) {
    if (alignment.align(map, frame_.cam_from_world, frame_.point_landmarks, frame_.frame) == 0) return;
    last_.read_back(frame_);
    if (refinement.refine(map, nullptr, frame_).ok()) return;
    frame_.read_back(last_);
  }

  // frame_ has its pose, as frame i.
  void place(std::size_t i, KeyframeId reference, const Map<S>& map, TrajectoryLog<S>& log) {
    log.set(map, frame_.frame.index, frame_.frame.stamp, reference, frame_.cam_from_world);
    previous_ = Previous{i, reference, frame_.cam_from_world};
    last_.read_back(frame_);
  }

  // Frames that no sweep has come to, such as those of a map that was given up: what they show may be in the
  // finished map. From each that is recognised its neighbours are tracked.
  template <class Stages>
  void find_lost(Map<S>& map, Stages& stages, TrajectoryLog<S>& log) {
    const auto lost = [&](std::size_t i) { return log.find(frames_[i].index) == nullptr; };
    KeyframeId reference = map.surviving(map.keyframes.front().id);
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      if (!lost(i)) continue;
      frame_.adopt(frames_[i]);
      const PoseEstimate<S> estimate = stages.relocalisation.find(
          map, stages.fallback, stages.refinement, [] { return true; }, frame_, reference);
      if (estimate.ok()) place(i, reference, map, log);
      std::swap(frames_[i], frame_.frame);
      if (!estimate.ok()) continue;
      for (std::size_t j = i + 1; j < frames_.size() && lost(j); ++j) track(j, 1, map, stages, log);
      for (std::size_t j = i; j-- > 0 && lost(j);) track(j, -1, map, stages, log);
    }
  }

  // What became keyframes is as it was seen, but for where its features are.
  void take_from_keyframes(const Map<S>& map, const TrajectoryLog<S>& log) {
    for (Frame<S>& frame : frames_) {
      const TrajectoryEntry<S>* entry = log.find(frame.index);
      if (entry == nullptr) continue;
      const Keyframe<S>& keyframe = map.keyframes[map.index(map.surviving(entry->reference))];
      if (keyframe.made_of(frame) && keyframe.frame.points.size() == frame.points.size())
        frame.points = keyframe.frame.points;
    }
  }

  // The frame's features into frame_, straightened where its motion is known: of a copy, as the next round
  // begins with what was seen.
  void take_features(std::size_t i, const Map<S>& map) {
    if (!shutter.straightens(i)) return frame_.adopt(frames_[i]);
    Frame<S> straight = straightened(i, map, previous_->reference);
    frame_.adopt(straight);
  }

  // A copy of frame i, its features straightened where its motion is known.
  [[nodiscard]] Frame<S> straightened(std::size_t i, const Map<S>& map, KeyframeId reference) const {
    Frame<S> straight = frames_[i];
    if (shutter.straightens(i))
      shutter.straighten(i, frames_[i], map, map.keyframes[map.index(reference)], straight);
    return straight;
  }

  // Frame i is the one that was passed last, if there is one and it has a pose.
  bool look_up(std::size_t i, const Map<S>& map, const TrajectoryLog<S>& log) {
    const TrajectoryEntry<S>* entry = i < frames_.size() ? log.find(frames_[i].index) : nullptr;
    if (entry == nullptr) return false;
    previous_ = Previous{i, map.surviving(entry->reference), TrajectoryLog<S>::pose(map, *entry)};
    return true;
  }

  [[nodiscard]] static std::size_t distance(std::size_t a, std::size_t b) noexcept {
    return a > b ? a - b : b - a;
  }

  std::vector<Frame<S>> frames_;  // as they were seen, without their normals, in order
  std::optional<Previous> previous_;
  TrackedFrame<S> frame_, last_, around_;  // of the last two the matches alone
  NeighbourTracking<S> neighbours_;
  MapExtension<S> extension_;
};
static_assert(FinalStage<FinalPass<double>, double>);

}  // namespace sslam
