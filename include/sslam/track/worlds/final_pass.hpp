// SPDX-License-Identifier: BSD-3-Clause
// The final pass, after the last frame: features that see one landmark are aligned, the whole map is adjusted
// at once, then every frame is tracked again in it. A frame keeps the errors of the young map that it was
// tracked in otherwise, and one that had no pose may get one, from its neighbours or by the place that it
// shows. Of a rolling shutter, whose read-out time is told or found, features are moved to the moment of the
// middle row, by the motion that the trajectory tells.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/map/feature_alignment.hpp"
#include "sslam/map/map_adjustment.hpp"
#include "sslam/map/seen_patches.hpp"
#include "sslam/track/contract/concepts.hpp"
#include "sslam/track/localise/relocalisation.hpp"
#include "sslam/track/worlds/read_out_search.hpp"
#include "sslam/track/worlds/rolling_shutter.hpp"
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
  MapAdjustment<S, BundleSolver<S>> adjustment;
  ReadOutSearch<S> read_out_search;
  FeatureAlignment<S> alignment;

  FinalPass() {
    adjustment.solver.options.max_iterations = 20;
    adjustment.solver.options.min_decrease = S(1e-5);
  }

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("", self.options, visit);
    visit_stage("adjustment.", self.adjustment, visit);
    visit_stage("alignment.", self.alignment, visit);
    visit_within("shutter.", self.read_out_search.options, visit);
  }

  // A frame has been tracked, or lost; its features are copied, with the patches of those that see landmarks.
  void keep(const TrackedFrame<S>& tracked) {
    if (frames_.size() >= options.max_frames) return;
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

  // The map has its last keyframe. Poses go into the log; the frames are forgotten.
  template <class Fallback, class Refinement>
  void run(Map<S>& map, Fallback& fallback, Refinement& refinement, Relocalisation<S>& relocalisation,
           TrajectoryLog<S>& log) {
    read_out_ = options.read_out;
    if (!map.empty() && !frames_.empty()) {
      log.sort();
      if (alignment.align(map) > 0) take_from_keyframes(map, log);
      const auto track_all = [&] {
        adjustment.optimise_all(map);
        last_.point_landmarks.clear();
        last_.line_landmarks.clear();
        previous_.reset();
        for (std::size_t i = 0; i < frames_.size(); ++i) track(i, 1, map, fallback, refinement, log);
      };
      if (read_out_ == 0) track_all();
      // Each round knows the motion better by which the next one straightens.
      for (int round = 0; round < kRounds && look_for_motion(map, log); ++round) {
        straighten_keyframes(read_out_, map, log);
        track_all();
      }
      previous_.reset();
      for (std::size_t i = frames_.size(); i-- > 0;)
        if (log.find(frames_[i].index) == nullptr) track(i, -1, map, fallback, refinement, log);
      find_lost(map, fallback, refinement, relocalisation, log);
    }
    frames_.clear();
    motions_.clear();
    previous_.reset();
  }

  // Seconds from the first row to the last by which the last run straightened, told or found; 0: it did not.
  [[nodiscard]] double read_out() const noexcept { return read_out_; }

 private:
  static constexpr int kRounds = 3;  // a fourth gains a tenth at most

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
      if (is_keyframe(map.keyframes[map.index(previous_->reference)], frames_[i])) return;
    }
    if (!previous_ || distance(i, previous_->position) > static_cast<std::size_t>(options.max_misses) + 1)
      return;
    const KeyframeId reference = previous_->reference;
    take_features(i, map);
    frame_.cam_from_world = previous_->cam_from_world;
    around_.read_back(map.keyframes[map.index(reference)]);
    recent_.gather(step > 0 ? last_ : around_, around_);
    PoseEstimate<S> estimate = fallback.track(map, recent_, nullptr, frame_);
    if (estimate.ok()) estimate = refinement.refine(map, nullptr, frame_);
    if (estimate.ok()) {
      align(map, refinement);
      place(i, reference, map, log);
    }
    if (!straightens(i)) std::swap(frames_[i], frame_.frame);
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
  template <class Fallback, class Refinement>
  void find_lost(Map<S>& map, Fallback& fallback, Refinement& refinement, Relocalisation<S>& relocalisation,
                 TrajectoryLog<S>& log) {
    const auto lost = [&](std::size_t i) { return log.find(frames_[i].index) == nullptr; };
    KeyframeId reference = map.surviving(map.keyframes.front().id);
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      if (!lost(i)) continue;
      frame_.adopt(frames_[i]);
      const PoseEstimate<S> estimate = relocalisation.find(
          map, fallback, refinement, [] { return true; }, frame_, reference);
      if (estimate.ok()) place(i, reference, map, log);
      std::swap(frames_[i], frame_.frame);
      if (!estimate.ok()) continue;
      for (std::size_t j = i + 1; j < frames_.size() && lost(j); ++j)
        track(j, 1, map, fallback, refinement, log);
      for (std::size_t j = i; j-- > 0 && lost(j);) track(j, -1, map, fallback, refinement, log);
    }
  }

  // What became keyframes is as it was seen, but for where its features are.
  void take_from_keyframes(const Map<S>& map, const TrajectoryLog<S>& log) {
    for (Frame<S>& frame : frames_) {
      const TrajectoryEntry<S>* entry = log.find(frame.index);
      if (entry == nullptr) continue;
      const Keyframe<S>& keyframe = map.keyframes[map.index(map.surviving(entry->reference))];
      if (is_keyframe(keyframe, frame) && keyframe.frame.points.size() == frame.points.size())
        frame.points = keyframe.frame.points;
    }
  }

  static bool is_keyframe(const Keyframe<S>& keyframe, const Frame<S>& frame) noexcept {
    return keyframe.frame.index == frame.index;
  }
  [[nodiscard]] bool straightens(std::size_t i) const noexcept { return i < motions_.size() && motions_[i]; }

  // The frame's features into frame_, straightened where its motion is known: of a copy, as the next round
  // begins with what was seen.
  void take_features(std::size_t i, const Map<S>& map) {
    if (!straightens(i)) return frame_.adopt(frames_[i]);
    straight_ = frames_[i];
    straighten(read_out_, i, map, map.keyframes[map.index(previous_->reference)], straight_);
    frame_.adopt(straight_);
  }

  // The features of frame i, whose motion is known, into `out`; their depths are those that the keyframe
  // tells.
  void straighten(double read_out, std::size_t i, const Map<S>& map, const Keyframe<S>& keyframe,
                  Frame<S>& out) const {
    const InverseDepths<S> depths = inverse_depths(map, keyframe, frames_[i], keyframe.cam_from_world);
    RollingShutter<S>{read_out}.straighten(frames_[i], *motions_[i], depths, out);
  }

  // How the camera moves at each frame; and the read-out, unless it was told. False where nothing is left to
  // straighten.
  bool look_for_motion(Map<S>& map, const TrajectoryLog<S>& log) {
    const bool told = options.read_out > 0;
    if (!told && !read_out_search.options.search) return false;
    std::vector<TimedPose<S>> poses(frames_.size());
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      poses[i].stamp = frames_[i].stamp;
      if (const TrajectoryEntry<S>* entry = log.find(frames_[i].index))
        poses[i].cam_from_world = TrajectoryLog<S>::pose(map, *entry);
    }
    motions_ = frame_motions<S>(poses);
    return told || look_for_read_out(map, log);
  }

  bool look_for_read_out(Map<S>& map, const TrajectoryLog<S>& log) {
    constexpr double kSettled = 0.001;  // seconds
    const double before = read_out_;
    const auto found = read_out_search.find(map, before, adjustment.solver.options,
                                            [&](double t) { straighten_keyframes(t, map, log); });
    if (!found || (before == 0 && read_out_search.negligible(*found)) || !(found->seconds > 0) ||
        std::abs(found->seconds - before) < kSettled) {
      straighten_keyframes(before, map, log);
      if (before == 0) motions_.clear();
      return false;
    }
    read_out_ = found->seconds;
    return true;
  }

  // The features of keyframes whose motion is known, from what was seen. No read-out: just that.
  void straighten_keyframes(double read_out, Map<S>& map, const TrajectoryLog<S>& log) {
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      if (!motions_[i]) continue;
      Keyframe<S>& keyframe = map.keyframes[map.index(map.surviving(log.find(frames_[i].index)->reference))];
      const Frame<S>& raw = frames_[i];
      const bool own = is_keyframe(keyframe, raw) && keyframe.frame.points.size() == raw.points.size() &&
                       keyframe.frame.lines.size() == raw.lines.size();
      if (own) straighten(read_out, i, map, keyframe, keyframe.frame);
    }
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

  std::vector<Frame<S>> frames_;                        // as they were seen, without their normals, in order
  std::vector<std::optional<FrameMotion<S>>> motions_;  // of a rolling shutter, one a frame
  Frame<S> straight_;
  double read_out_ = 0;
  std::optional<Previous> previous_;
  TrackedFrame<S> frame_, last_, around_;  // of the last two the matches alone
  RecentLandmarks<S> recent_;
};
static_assert(FinalStage<FinalPass<double>, double>);

}  // namespace sslam
