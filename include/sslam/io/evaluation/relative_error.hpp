// SPDX-License-Identifier: BSD-3-Clause
// The relative pose error: how wrong the motion over a step is.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "sslam/io/evaluation/paired_poses.hpp"
#include "sslam/io/evaluation/statistics.hpp"
#include "sslam/io/files/stamp_unit.hpp"

namespace sslam::io {

enum class DeltaUnit { kFrames, kSeconds };

// The step over which a relative error is taken.
struct Delta {
  double value = 1;
  DeltaUnit unit = DeltaUnit::kSeconds;
};

struct RelativeError {
  Delta delta;
  Statistics translation;  // metres
  Statistics rotation;     // radians
};

// Index of the far end of the step that starts at pose i, as the TUM tools choose it: the pose nearest to the
// wanted place. They leave out every step that ends at the last pose, since it may have been cut short; so do
// we. A step that a gap in the trajectory makes more than half longer or shorter than wanted is none. Returns
// stamps.size() for none.
[[nodiscard]] inline std::size_t step_end(std::span<const double> stamps, std::size_t i, const Delta& delta,
                                          double seconds_per_stamp, double usual_step) {
  constexpr double kTolerance = 0.5;
  const std::size_t last = stamps.size() - 1;
  std::size_t j = last;
  if (delta.unit == DeltaUnit::kSeconds) {
    j = nearest_stamp(stamps, stamps[i] + delta.value / seconds_per_stamp);
  } else if (delta.value < static_cast<double>(last - i)) {
    j = i + static_cast<std::size_t>(std::lround(delta.value));
  }
  if (j >= last || j <= i) return stamps.size();
  const double wanted =
      delta.unit == DeltaUnit::kSeconds ? delta.value / seconds_per_stamp : delta.value * usual_step;
  const bool gap = wanted > 0 && std::abs(stamps[j] - stamps[i] - wanted) > kTolerance * wanted;
  return gap ? stamps.size() : j;
}

// E = (Q_i^-1 Q_j)^-1 (P_i^-1 P_j), with the estimate's translation scaled.
[[nodiscard]] inline RelativeError relative_error(const PairedPoses& paired, const Delta& delta, double scale,
                                                  double seconds_per_stamp) {
  std::vector<double> translation;
  std::vector<double> rotation;
  const std::vector<double> stamps = stamps_of(paired.estimate);
  const double usual_step = median_step(stamps);
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const std::size_t j = step_end(stamps, i, delta, seconds_per_stamp, usual_step);
    if (j == stamps.size()) continue;
    const SE3<double> true_step = paired.truth[i].world_from_cam.inverse() * paired.truth[j].world_from_cam;
    SE3<double> step = paired.estimate[i].world_from_cam.inverse() * paired.estimate[j].world_from_cam;
    step.translation *= scale;
    const SE3<double> error = true_step.inverse() * step;
    translation.push_back(error.translation.norm());
    rotation.push_back(angle_between(error.rotation, SO3<double>{}));
  }
  return {delta, statistics_of(translation), statistics_of(rotation)};
}

}  // namespace sslam::io
