// SPDX-License-Identifier: BSD-3-Clause
// What a map amounts to: how many landmarks are alive in it, and where its keyframes stand.
#pragma once

#include <algorithm>
#include <cstddef>

#include "sslam/io/trajectories/trajectory.hpp"
#include "sslam/map/map.hpp"

namespace sslam::cli {

template <class Landmarks>
[[nodiscard]] std::size_t count_alive(const Landmarks& landmarks) {
  return static_cast<std::size_t>(
      std::count_if(landmarks.begin(), landmarks.end(), [](const auto& landmark) { return landmark.alive; }));
}

// Those from the id `first` on that are alive, by their stamps.
[[nodiscard]] inline io::Trajectory keyframe_poses(const Map<double>& map, std::size_t first = 0) {
  io::Trajectory poses;
  for (std::size_t k = first; k < map.keyframes.size(); ++k)
    if (const auto& keyframe = map.keyframes[k]; keyframe.alive())
      poses.push_back({keyframe.frame.stamp, keyframe.cam_from_world.inverse()});
  io::sort_by_stamp(poses);
  return poses;
}

}  // namespace sslam::cli
