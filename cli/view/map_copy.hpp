// SPDX-License-Identifier: BSD-3-Clause
// What of a map and its path is copied in the tracker's thread for those who look on.
#pragma once

#include "cli/results/map_colours.hpp"
#include "sslam/io/trajectories/trajectory.hpp"
#include "sslam/system/observer.hpp"

namespace sslam::cli {

// The landmarks that are alive, and their colours.
[[nodiscard]] inline Map<double> landmarks_of(const Map<double>& map, const MapColours& colours,
                                              MapColours& seen_colours) {
  Map<double> seen;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const auto& point = map.points[i];
    if (!point.alive) continue;
    seen_colours.points.push_back(colour_at(colours.points, i));
    auto& copy = seen.points.emplace_back();
    copy.position = point.position;
    copy.plane = point.plane;
  }
  for (std::size_t i = 0; i < map.lines.size(); ++i) {
    const auto& line = map.lines[i];
    if (!line.alive) continue;
    seen_colours.lines.push_back(colour_at(colours.lines, i));
    auto& copy = seen.lines.emplace_back();
    copy.start = line.start;
    copy.end = line.end;
    copy.axis = line.axis;
    copy.plane = line.plane;
  }
  seen.planes = map.planes;
  return seen;
}

// All frames with a pose, as the keyframes now place them.
[[nodiscard]] inline io::Trajectory trajectory_of(const FrameEvent& event) {
  io::Trajectory trajectory;
  for (const auto& entry : event.trajectory.entries())
    trajectory.push_back({entry.stamp, TrajectoryLog<double>::pose(event.map, entry).inverse()});
  return trajectory;
}

}  // namespace sslam::cli
