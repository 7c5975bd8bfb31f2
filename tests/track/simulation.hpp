// SPDX-License-Identifier: BSD-3-Clause
// A camera that moves through the simulated room: each landmark has its own descriptor, each frame its own
// noise.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "sslam/track/presets.hpp"
#include "support/map_scene.hpp"

namespace sslam::testing {

class Simulation {
 public:
  explicit Simulation(std::vector<SE3<double>> path, const MapSceneOptions& options = room(),
                      std::uint64_t look = 99)
      : scene_(options, std::move(path)) {
    Random random(look);
    for (std::size_t i = 0; i < scene_.points.size(); ++i) point_descriptors_.push_back(draw(random));
    for (std::size_t i = 0; i < scene_.lines.size(); ++i) line_descriptors_.push_back(draw(random));
  }

  [[nodiscard]] static MapSceneOptions room() {
    MapSceneOptions options;
    options.points = 1500;
    options.lines = 250;
    return options;
  }

  [[nodiscard]] std::size_t size() const { return scene_.poses.size(); }
  [[nodiscard]] const SE3<double>& truth(std::size_t k) const { return scene_.poses[k]; }

  // What the front end would hand over for frame k, at 30 frames a second.
  [[nodiscard]] Frame<double> frame(std::size_t k) { return std::move(see(k).frame); }

  // With the true geometry and a keyframe at each `step`-th pose.
  [[nodiscard]] Map<double> true_map(std::size_t step) {
    Map<double> map = scene_.make_landmarks();
    for (std::size_t k = 0; k < size(); k += step) map.add_keyframe(see(k));
    return map;
  }

  // An image with nothing on it: a covered lens.
  [[nodiscard]] Frame<double> dark_frame(std::size_t k) {
    Frame<double> dark = frame(k);
    dark.points.clear();
    dark.lines.clear();
    return dark;
  }

 private:
  [[nodiscard]] Keyframe<double> see(std::size_t k) {
    Keyframe<double> seen = scene_.make_keyframe(k, scene_.poses[k]);
    for (std::size_t i = 0; i < seen.frame.points.size(); ++i)
      seen.frame.points[i].descriptor =
          noisy(point_descriptors_[Map<double>::index(seen.point_landmarks[i])]);
    for (std::size_t i = 0; i < seen.frame.lines.size(); ++i)
      seen.frame.lines[i].descriptor = noisy(line_descriptors_[Map<double>::index(seen.line_landmarks[i])]);
    seen.frame.index = static_cast<std::int64_t>(k);
    seen.frame.stamp = static_cast<double>(k) / 30;
    return seen;
  }

  static Descriptor draw(Random& random) {
    Descriptor d;
    for (auto& word : d.words) word = random.next();
    return d;
  }

  // A few bits flip from view to view.
  Descriptor noisy(Descriptor d) {
    for (int i = 0; i < 12; ++i) d.words[scene_.random().below(4)] ^= 1ULL << scene_.random().below(64);
    return d;
  }

  MapScene scene_;
  std::vector<Descriptor> point_descriptors_, line_descriptors_;
};

// Sideways and forwards with some turning, `frames` long.
[[nodiscard]] inline std::vector<SE3<double>> walk(std::size_t frames) {
  std::vector<SE3<double>> path;
  for (std::size_t k = 0; k < frames; ++k) {
    const double t = static_cast<double>(k) / 30;
    path.push_back(look({0.5 * std::sin(0.8 * t), 0.1 * std::sin(1.1 * t), 0.2 * t - 2},
                        0.2 * std::sin(0.5 * t), 0.05 * std::sin(t)));
  }
  return path;
}

// Turns in place: rotation without parallax.
[[nodiscard]] inline std::vector<SE3<double>> turn_in_place(std::size_t frames) {
  std::vector<SE3<double>> path;
  for (std::size_t k = 0; k < frames; ++k)
    path.push_back(look({0, 0, -2}, 0.3 * std::sin(static_cast<double>(k) / 30), 0.02));
  return path;
}

template <class P>
std::vector<TrackResult<double>> track_first(P& pipeline, Simulation& simulation, std::size_t frames) {
  std::vector<TrackResult<double>> results;
  for (std::size_t k = 0; k < frames; ++k) {
    Frame<double> frame = simulation.frame(k);
    results.push_back(pipeline.track(frame));
  }
  return results;
}

template <class P>
std::vector<TrackResult<double>> track_all(P& pipeline, Simulation& simulation) {
  return track_first(pipeline, simulation, simulation.size());
}

// RMSE of the camera centres of a trajectory after the best similarity: its ATE.
[[nodiscard]] inline double position_error(const Map<double>& map, const TrajectoryLog<double>& log,
                                           const Simulation& simulation) {
  const auto& entries = log.entries();
  const auto count = static_cast<Eigen::Index>(entries.size());
  Eigen::Matrix3Xd estimate(3, count), truth(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& entry = entries[static_cast<std::size_t>(i)];
    estimate.col(i) = TrajectoryLog<double>::pose(map, entry).inverse().translation;
    truth.col(i) = simulation.truth(static_cast<std::size_t>(entry.index)).inverse().translation;
  }
  const Eigen::Matrix4d truth_from_estimate = Eigen::umeyama(estimate, truth);
  const Eigen::Matrix3Xd aligned = (truth_from_estimate.topLeftCorner<3, 3>() * estimate).colwise() +
                                   truth_from_estimate.topRightCorner<3, 1>();
  return std::sqrt((aligned - truth).colwise().squaredNorm().mean());
}

template <class P>
[[nodiscard]] double position_error(const P& pipeline, const Simulation& simulation) {
  return position_error(pipeline.map(), pipeline.trajectory(), simulation);
}

[[nodiscard]] inline int count(const std::vector<TrackResult<double>>& results, State state) {
  return static_cast<int>(
      std::count_if(results.begin(), results.end(), [&](const auto& r) { return r.state == state; }));
}

// Poses that structure had a part in, and that agree with it.
[[nodiscard]] inline int count_structure(const std::vector<TrackResult<double>>& results) {
  return static_cast<int>(std::count_if(results.begin(), results.end(),
                                        [](const auto& r) { return r.has_pose() && r.structure; }));
}

}  // namespace sslam::testing
