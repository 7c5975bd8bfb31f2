// SPDX-License-Identifier: BSD-3-Clause
// Straightens what a rolling shutter has bent, in the frames of a run and in its map. Features that were bent
// too far were matched to nothing while the map was made, or to a landmark of their own: what is left makes
// the read-out seem shorter than it is. So keyframes are matched anew once they are straightened, and asked
// again.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "sslam/map/map_adjustment.hpp"
#include "sslam/track/mapping/fusion.hpp"
#include "sslam/track/worlds/read_out_search.hpp"
#include "sslam/track/worlds/rolling_shutter.hpp"
#include "sslam/track/worlds/trajectory_log.hpp"

namespace sslam {

template <Scalar S>
class ShutterStraightening {
 public:
  ReadOutSearch<S> search;
  LandmarkFusion<S> fusion;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("shutter.", self.search.options, visit);
    visit_stage("fusion.", self.fusion, visit);
  }

  // Another run begins. Seconds from the first row of an image to the last; 0: not told.
  void begin(double read_out) {
    told_ = read_out > 0;
    read_out_ = read_out;
    motions_.clear();
  }

  // The frames as they were seen have the poses of the log. Features of the map's keyframes move, and the map
  // is adjusted to them. False: all is straight as it is.
  bool straighten_map(const std::vector<Frame<S>>& frames, const TrajectoryLog<S>& log,
                      MapAdjustment<S>& adjustment, Map<S>& map) {
    if (!told_ && !search.options.search) return false;
    look_for_motion(frames, log, map);
    bool moved = false;
    for (int k = 0; k < (told_ ? 1 : kSearches); ++k) {
      if (!told_ && !look_for_read_out(frames, log, adjustment.solver.options, map)) break;
      straighten_keyframes(frames, log, read_out_, map);
      match_anew(map);
      adjustment.optimise_all(map);
      moved = true;
    }
    return moved;
  }

  // Whether the motion of frame i is known, by which it can be straightened.
  [[nodiscard]] bool straightens(std::size_t i) const noexcept { return i < motions_.size() && motions_[i]; }

  // The features of frame i, as seen in `raw`, into `out`; their depths are those that the keyframe tells.
  void straighten(std::size_t i, const Frame<S>& raw, const Map<S>& map, const Keyframe<S>& keyframe,
                  Frame<S>& out) const {
    straighten(read_out_, i, raw, map, keyframe, out);
  }

  // Seconds, told or found; 0: all rows are read at once.
  [[nodiscard]] double read_out() const noexcept { return read_out_; }

 private:
  static constexpr int kSearches = 8;        // each goes a third to a half of the way that is left
  static constexpr double kSettled = 0.001;  // seconds

  void straighten(double read_out, std::size_t i, const Frame<S>& raw, const Map<S>& map,
                  const Keyframe<S>& keyframe, Frame<S>& out) const {
    const InverseDepths<S> depths = inverse_depths(map, keyframe, raw, keyframe.cam_from_world);
    RollingShutter<S>{read_out}.straighten(raw, *motions_[i], depths, out);
  }

  // How the camera moves at each frame.
  void look_for_motion(const std::vector<Frame<S>>& frames, const TrajectoryLog<S>& log, const Map<S>& map) {
    std::vector<TimedPose<S>> poses(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      poses[i].stamp = frames[i].stamp;
      if (const TrajectoryEntry<S>* entry = log.find(frames[i].index))
        poses[i].cam_from_world = TrajectoryLog<S>::pose(map, *entry);
    }
    motions_ = frame_motions<S>(poses);
  }

  // False: the observations leave it open, or it is what it was.
  bool look_for_read_out(const std::vector<Frame<S>>& frames, const TrajectoryLog<S>& log,
                         const BundleOptions<S>& solver, Map<S>& map) {
    const double before = read_out_;
    const auto found =
        search.find(map, before, solver, [&](double t) { straighten_keyframes(frames, log, t, map); });
    if (!found || (before == 0 && search.negligible(*found)) || !(found->seconds > 0) ||
        std::abs(found->seconds - before) < kSettled) {
      straighten_keyframes(frames, log, before, map);
      if (before == 0) motions_.clear();
      return false;
    }
    read_out_ = found->seconds;
    return true;
  }

  // The features of keyframes whose motion is known, from what was seen. No read-out: just that.
  void straighten_keyframes(const std::vector<Frame<S>>& frames, const TrajectoryLog<S>& log, double read_out,
                            Map<S>& map) const {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (!motions_[i]) continue;
      const Frame<S>& raw = frames[i];
      Keyframe<S>& keyframe = map.keyframes[map.index(map.surviving(log.find(raw.index)->reference))];
      const bool own = keyframe.made_of(raw) && keyframe.frame.points.size() == raw.points.size() &&
                       keyframe.frame.lines.size() == raw.lines.size();
      if (own) straighten(read_out, i, raw, map, keyframe, keyframe.frame);
    }
  }

  void match_anew(Map<S>& map) {
    for (std::size_t k = 0; k < map.keyframes.size(); ++k) {
      if (!map.keyframes[k].alive()) continue;
      fusion.fuse(map, static_cast<KeyframeId>(k));
      map.update_covisibility(static_cast<KeyframeId>(k));
    }
  }

  bool told_ = false;
  double read_out_ = 0;
  std::vector<std::optional<FrameMotion<S>>> motions_;  // one a frame
};

}  // namespace sslam
