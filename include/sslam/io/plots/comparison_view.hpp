// SPDX-License-Identifier: BSD-3-Clause
// An estimate over its ground truth, ready to be drawn.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "sslam/core/median.hpp"
#include "sslam/geometry/sim3.hpp"
#include "sslam/io/plots/svg_plot.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::io {

// The whole estimate in the ground truth's world.
[[nodiscard]] inline Trajectory aligned(const Trajectory& estimate, const Sim3<double>& truth_from_estimate) {
  Trajectory result = estimate;
  for (StampedPose& pose : result) {
    pose.world_from_cam.translation = truth_from_estimate * pose.world_from_cam.translation;
    pose.world_from_cam.rotation = truth_from_estimate.rotation * pose.world_from_cam.rotation;
  }
  return result;
}

// The longest pause in stamps that is still an ordinary step: five times the median one. 0 for fewer than 2
// poses.
[[nodiscard]] inline double ordinary_gap(const Trajectory& trajectory) {
  constexpr double kFactor = 5;
  if (trajectory.size() < 2) return 0;
  std::vector<double> steps;
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    steps.push_back(trajectory[i].stamp - trajectory[i - 1].stamp);
  return kFactor * median<double>(steps);
}

// The estimate, aligned, over that part of the ground truth that was recorded from `from` to `to` (stamps).
[[nodiscard]] inline TopView comparison_view(const Trajectory& truth, const Trajectory& estimate,
                                             const Sim3<double>& truth_from_estimate, double from, double to,
                                             std::string title) {
  TopView view;
  view.title = std::move(title);
  view.estimate = aligned(estimate, truth_from_estimate);
  view.max_gap = ordinary_gap(estimate);
  for (const StampedPose& pose : truth) {
    if (pose.stamp >= from && pose.stamp <= to) view.truth.push_back(pose);
  }
  return view;
}

}  // namespace sslam::io
