// SPDX-License-Identifier: BSD-3-Clause
// Bends the map: every keyframe moves by a similarity of its own, and what it sees moves along.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "sslam/geometry/sim3.hpp"
#include "sslam/map/map.hpp"

namespace sslam {

// new_from_old[k], in the world, for each keyframe that is alive. A landmark follows the first keyframe that
// observes it; the place of a removed keyframe follows its heir, and its entry in new_from_old becomes the
// heir's.
template <Scalar S>
void deform(Map<S>& map, std::span<Sim3<S>> new_from_old) {
  const auto index = [](std::int32_t id) { return Map<S>::index(id); };
  for (Keyframe<S>& kf : map.keyframes) {
    const Sim3<S>& moved = new_from_old[index(kf.id)] = new_from_old[index(map.carrier(kf.id))];
    if (!kf.alive()) {
      kf.cam_from_heir.translation *= moved.scale;
      continue;
    }
    const SE3<S> world_from_cam = kf.cam_from_world.inverse();
    kf.cam_from_world =
        SE3<S>{moved.rotation * world_from_cam.rotation, moved * world_from_cam.translation}.inverse();
  }
  for (PointLandmark<S>& point : map.points) {
    if (!point.alive || point.observations.empty()) continue;
    const Sim3<S>& moved = new_from_old[index(point.observations.front().keyframe)];
    point.position = moved * point.position;
    point.viewing_direction = moved.rotation * point.viewing_direction;
    point.extent *= moved.scale;
  }
  for (LineLandmark<S>& line : map.lines) {
    if (!line.alive || line.observations.empty()) continue;
    const Sim3<S>& moved = new_from_old[index(line.observations.front().keyframe)];
    line.line = transform(moved, line.line);
    line.start = moved * line.start;
    line.end = moved * line.end;
  }
}

}  // namespace sslam
