// SPDX-License-Identifier: BSD-3-Clause
// Whether a map that came from outside holds together.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sslam/core/error.hpp"
#include "sslam/map/map.hpp"

namespace sslam::io {

// Throws Error when ids point outside the map or numbers are not finite: such a map would crash its reader.
inline void check_map(const Map<double>& map) {
  const auto demand = [](bool holds) {
    if (!holds) throw Error("contradicts itself");
  };
  const auto inside = [](std::int32_t id, std::size_t size) {
    return id >= 0 && static_cast<std::size_t>(id) < size;
  };
  const int axes = 3 * static_cast<int>(map.world_from_manhattan.size());
  demand(!map.keyframes.empty() && map.keyframes.front().alive());
  for (std::size_t k = 0; k < map.keyframes.size(); ++k) {
    const Keyframe<double>& kf = map.keyframes[k];
    demand(kf.id == static_cast<KeyframeId>(k));
    demand(kf.cam_from_world.translation.allFinite() && kf.cam_from_world.rotation.matrix().allFinite());
    // Parents come from those that were alive when it went; a ring of them would have no pose.
    KeyframeId parent = kf.parent;
    for (std::size_t steps = 0; parent != kNone; ++steps) {
      demand(inside(parent, map.keyframes.size()) && steps < map.keyframes.size());
      parent = map.keyframes[map.index(parent)].parent;
    }
    demand(kf.point_landmarks.size() == kf.frame.points.size());
    demand(kf.line_landmarks.size() == kf.frame.lines.size());
    demand(kf.line_axes.empty() || kf.line_axes.size() == kf.frame.lines.size());
    for (const std::int8_t axis : kf.line_axes) demand(axis >= kNone && axis < axes);
    for (const LandmarkId id : kf.point_landmarks) demand(id == kNone || inside(id, map.points.size()));
    for (const LandmarkId id : kf.line_landmarks) demand(id == kNone || inside(id, map.lines.size()));
    for (const Neighbour& n : kf.neighbours) demand(inside(n.keyframe, map.keyframes.size()));
  }
  const auto check_landmarks = [&](const auto& landmarks, auto features) {
    for (const auto& landmark : landmarks) {
      demand(landmark.plane == kNone ||
             (inside(landmark.plane, map.planes.size()) && map.planes[map.index(landmark.plane)].alive));
      for (const Observation& o : landmark.observations)
        demand(inside(o.keyframe, map.keyframes.size()) &&
               inside(o.feature, features(map.keyframes[map.index(o.keyframe)])));
    }
  };
  check_landmarks(map.points, [](const Keyframe<double>& kf) { return kf.frame.points.size(); });
  check_landmarks(map.lines, [](const Keyframe<double>& kf) { return kf.frame.lines.size(); });
  for (const auto& p : map.points) demand(p.position.allFinite());
  for (const auto& l : map.lines) demand(l.line.moment.allFinite() && l.axis >= kNone && l.axis < axes);
  for (const auto& p : map.planes)
    demand(std::abs(p.plane.normal.norm() - 1) < 1e-6 && std::isfinite(p.plane.distance) && p.axis >= kNone &&
           p.axis < axes);
}

}  // namespace sslam::io
