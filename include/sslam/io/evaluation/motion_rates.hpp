// SPDX-License-Identifier: BSD-3-Clause
// How fast a trajectory turns and moves over time: what two records of one camera have in common, whatever
// their worlds.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "sslam/core/median.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::io::motion_rates {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

[[nodiscard]] inline double median_step(const Trajectory& poses) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < poses.size(); ++i) steps.push_back(poses[i].stamp - poses[i - 1].stamp);
  return steps.empty() ? 0 : median<double>(steps);
}

// Turn rate and speed every `grid` from the first stamp on, each over a window; not a number across gaps.
struct Motion {
  double start = 0;
  std::array<std::vector<double>, 2> rates;
};

// The pose at a time between two stamps; false beyond both ends, and across a gap.
[[nodiscard]] inline bool pose_at(const Trajectory& poses, double time, double largest_gap, std::size_t& near,
                                  SE3<double>& pose) {
  while (near + 2 < poses.size() && poses[near + 1].stamp <= time) ++near;
  while (near > 0 && poses[near].stamp > time) --near;
  const StampedPose &a = poses[near], &b = poses[near + 1];
  const double step = b.stamp - a.stamp;
  if (time < a.stamp || time > b.stamp || !(step > 0) || step > largest_gap) return false;
  const double share = (time - a.stamp) / step;
  const SO3<double> turn = a.world_from_cam.rotation.inverse() * b.world_from_cam.rotation;
  pose.rotation = a.world_from_cam.rotation * SO3<double>::exp(Vec3<double>(turn.log() * share));
  pose.translation = (1 - share) * a.world_from_cam.translation + share * b.world_from_cam.translation;
  return true;
}

[[nodiscard]] inline Motion motion_of(const Trajectory& poses, double grid, double window) {
  constexpr double kGap = 5;  // usual steps
  const double largest_gap = kGap * median_step(poses);
  const auto count = static_cast<std::size_t>((poses.back().stamp - poses.front().stamp) / grid) + 1;
  Motion motion;
  motion.start = poses.front().stamp;
  std::size_t near_before = 0, near_after = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double time = motion.start + static_cast<double>(i) * grid;
    SE3<double> before, after;
    const bool known = pose_at(poses, time - window / 2, largest_gap, near_before, before) &&
                       pose_at(poses, time + window / 2, largest_gap, near_after, after);
    motion.rates[0].push_back(known ? angle_between(before.rotation, after.rotation) / window : kUnknown);
    motion.rates[1].push_back(known ? (after.translation - before.translation).norm() / window : kUnknown);
  }
  return motion;
}

// Whether a rate changes at all, against what is left of its noise.
[[nodiscard]] inline bool varies(const std::vector<double>& rates) {
  constexpr double kLeast = 0.1;  // standard deviation over mean
  double n = 0, sum = 0, squares = 0;
  for (const double rate : rates)
    if (std::isfinite(rate)) {
      n += 1;
      sum += rate;
      squares += rate * rate;
    }
  if (n < 3 || !(sum > 0)) return false;
  const double mean = sum / n;
  return std::sqrt(std::max(0.0, squares / n - mean * mean)) > kLeast * mean;
}

}  // namespace sslam::io::motion_rates
