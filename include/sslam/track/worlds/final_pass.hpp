// SPDX-License-Identifier: BSD-3-Clause
// The final pass, after the last frame: the whole map is adjusted at once, then every frame is tracked again
// in it. A frame keeps the errors of the young map that it was tracked in otherwise, and one that had no pose
// may get one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/map/map_adjustment.hpp"
#include "sslam/track/contract/concepts.hpp"
#include "sslam/track/worlds/trajectory_log.hpp"

namespace sslam {

template <Scalar S>
struct FinalPassOptions {
  std::size_t max_frames = 3000;  // that are kept for it, 100 kB each; those after them stay as they are
  int max_misses = 5;  // frames in a row without a pose, beyond which a sweep does not guess where it is

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_frames", self.max_frames, Unit::kCount, 0, 10000000,
          "that are kept to be tracked again, 100 kB each; the others keep their poses");
    visit("max_misses", self.max_misses, Unit::kCount, 0, 1000,
          "frames in a row without a pose while those behind them get one");
  }
};
static_assert(Described<FinalPassOptions<double>>);

template <Scalar S>
class FinalPass {
 public:
  FinalPassOptions<S> options;
  MapAdjustment<S, BundleSolver<S>> adjustment;

  FinalPass() {
    adjustment.solver.options.max_iterations = 20;
    adjustment.solver.options.min_decrease = S(1e-5);
  }

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("", self.options, visit);
    visit_stage("adjustment.", self.adjustment, visit);
  }

  // A frame has been tracked, or lost; its features are copied.
  void keep(const Frame<S>& frame) {
    if (frames_.size() >= options.max_frames) return;
    Frame<S>& kept = frames_.emplace_back();
    kept.index = frame.index;
    kept.stamp = frame.stamp;
    kept.pinhole = frame.pinhole;
    kept.width = frame.width;
    kept.height = frame.height;
    kept.points = frame.points;
    kept.lines = frame.lines;
  }

  // The map has its last keyframe. Poses go into the log; the frames are forgotten.
  template <class Fallback, class Refinement>
  void run(Map<S>& map, Fallback& fallback, Refinement& refinement, TrajectoryLog<S>& log) {
    if (!map.empty() && !frames_.empty()) {
      adjustment.optimise_all(map);
      log.sort();
      last_.point_landmarks.clear();
      last_.line_landmarks.clear();
      for (std::size_t i = 0; i < frames_.size(); ++i) track(i, 1, map, fallback, refinement, log);
      previous_.reset();
      for (std::size_t i = frames_.size(); i-- > 0;)
        if (log.find(frames_[i].index) == nullptr) track(i, -1, map, fallback, refinement, log);
    }
    frames_.clear();
    previous_.reset();
  }

 private:
  // The frame that the sweep came through last and knows a pose of.
  struct Previous {
    std::size_t position;  // in frames_
    KeyframeId reference;
    SE3<S> cam_from_world;
  };

  template <class Fallback, class Refinement>
  void track(std::size_t i, int step, Map<S>& map, Fallback& fallback, Refinement& refinement,
             TrajectoryLog<S>& log) {
    if (step < 0) look_up(i + 1, map, log);
    const TrajectoryEntry<S>* entry = log.find(frames_[i].index);
    if (entry != nullptr) {
      previous_ = Previous{i, map.surviving(entry->reference), TrajectoryLog<S>::pose(map, *entry)};
      if (map.keyframes[map.index(previous_->reference)].frame.index == frames_[i].index) return;
    }
    if (!previous_ || distance(i, previous_->position) > static_cast<std::size_t>(options.max_misses) + 1)
      return;
    const KeyframeId reference = previous_->reference;
    frame_.adopt(frames_[i]);
    frame_.cam_from_world = previous_->cam_from_world;
    around_.read_back(map.keyframes[map.index(reference)]);
    recent_.gather(step > 0 ? last_ : around_, around_);
    PoseEstimate<S> estimate = fallback.track(map, recent_, nullptr, frame_);
    if (estimate.ok()) estimate = refinement.refine(map, nullptr, frame_);
    if (estimate.ok()) {
      log.set(map, frame_.frame.index, frame_.frame.stamp, reference, frame_.cam_from_world);
      previous_ = Previous{i, reference, frame_.cam_from_world};
      last_.read_back(frame_);
    }
    std::swap(frames_[i], frame_.frame);
  }

  // Going backwards, a frame that has a pose is passed without being tracked again.
  void look_up(std::size_t i, const Map<S>& map, const TrajectoryLog<S>& log) {
    if (i >= frames_.size()) return;
    if (const TrajectoryEntry<S>* entry = log.find(frames_[i].index))
      previous_ = Previous{i, map.surviving(entry->reference), TrajectoryLog<S>::pose(map, *entry)};
  }

  [[nodiscard]] static std::size_t distance(std::size_t a, std::size_t b) noexcept {
    return a > b ? a - b : b - a;
  }

  std::vector<Frame<S>> frames_;  // without their normals, in order
  std::optional<Previous> previous_;
  TrackedFrame<S> frame_, last_, around_;  // of the last two the matches alone
  RecentLandmarks<S> recent_;
};
static_assert(FinalStage<FinalPass<double>, double>);

// Poses and map stay as tracking and mapping left them.
template <Scalar S>
struct NoFinalPass {
  void keep(const Frame<S>&) noexcept {}
  template <class Fallback, class Refinement>
  void run(Map<S>&, Fallback&, Refinement&, TrajectoryLog<S>&) noexcept {}
};
static_assert(FinalStage<NoFinalPass<double>, double>);

}  // namespace sslam
