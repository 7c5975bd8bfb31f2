// SPDX-License-Identifier: BSD-3-Clause
// The ground truth, and how far each frame is from it, for the report's page.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "cli/report/frame_rows.hpp"
#include "cli/report/packed.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::cli {

[[nodiscard]] inline nlohmann::ordered_json truth_data(const io::Trajectory& truth) {
  std::vector<double> positions, stamps;
  for (const io::StampedPose& pose : truth) {
    append(positions, pose.world_from_cam.translation);
    stamps.push_back(pose.stamp);
  }
  return {{"positions", floats(positions)}, {"stamps", packed<double>("f64", stamps)}};
}

// Of the estimate's poses: metres, and radians.
[[nodiscard]] inline nlohmann::ordered_json error_data(const FrameRows& rows, const io::Trajectory& estimate,
                                                       std::span<const double> distances,
                                                       std::span<const double> angles) {
  std::vector<double> position = rows.empty(1), rotation = position;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const auto row = rows.row_of(estimate[i].stamp);
    if (!row) continue;
    position[*row] = distances[i];
    rotation[*row] = degrees(angles[i]);
  }
  return {{"position_m", floats(position)}, {"rotation_deg", floats(rotation)}};
}

}  // namespace sslam::cli
