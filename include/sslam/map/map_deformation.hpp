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

namespace detail {

// Where the members of a plane take it: the mean of their turns, through their middle.
template <Scalar S>
struct MovedPlane {
  Vec3<S> normal;
  Vec3<S> normals = Vec3<S>::Zero(), places = Vec3<S>::Zero();
  int members = 0;

  void add(const Sim3<S>& moved, const Vec3<S>& place) {
    normals += moved.rotation * normal;
    places += moved * place;
    ++members;
  }
  void put(Plane3<S>& plane) const {
    if (members == 0 || !(normals.norm() > 0)) return;
    plane.normal = normals.normalized();
    plane.distance = plane.normal.dot(places) / static_cast<S>(members);
  }
};

}  // namespace detail

// cam_from_world of a camera that moves along with the world; a camera has no scale.
template <Scalar S>
[[nodiscard]] SE3<S> carried(const Sim3<S>& new_from_old, const SE3<S>& cam_from_world) {
  const SE3<S> world_from_cam = cam_from_world.inverse();
  return SE3<S>{new_from_old.rotation * world_from_cam.rotation, new_from_old * world_from_cam.translation}
      .inverse();
}

// new_from_old[k], in the world, for each keyframe that is alive. A landmark follows the first keyframe that
// observes it, a plane the mean of its members; the place of a removed keyframe follows its parent, and its
// entry in new_from_old becomes the parent's.
template <Scalar S>
void deform(Map<S>& map, std::span<Sim3<S>> new_from_old) {
  const auto index = [](std::int32_t id) { return Map<S>::index(id); };
  for (Keyframe<S>& kf : map.keyframes) {
    const Sim3<S>& moved = new_from_old[index(kf.id)] = new_from_old[index(map.surviving(kf.id))];
    if (!kf.alive()) {
      kf.cam_from_parent.translation *= moved.scale;
      continue;
    }
    kf.cam_from_world = carried(moved, kf.cam_from_world);
  }
  std::vector<detail::MovedPlane<S>> planes;
  for (const PlaneLandmark<S>& plane : map.planes) planes.push_back({plane.plane.normal});
  for (PointLandmark<S>& point : map.points) {
    if (!point.alive || point.observations.empty()) continue;
    const Sim3<S>& moved = new_from_old[index(point.observations.front().keyframe)];
    if (point.plane != kNone) planes[index(point.plane)].add(moved, point.position);
    point.position = moved * point.position;
    point.viewing_direction = moved.rotation * point.viewing_direction;
    point.extent *= moved.scale;
  }
  for (LineLandmark<S>& line : map.lines) {
    if (!line.alive || line.observations.empty()) continue;
    const Sim3<S>& moved = new_from_old[index(line.observations.front().keyframe)];
    if (line.plane != kNone) planes[index(line.plane)].add(moved, (line.start + line.end) / 2);
    line.line = transform(moved, line.line);
    line.start = moved * line.start;
    line.end = moved * line.end;
  }
  for (std::size_t p = 0; p < planes.size(); ++p)
    if (map.planes[p].alive) planes[p].put(map.planes[p].plane);
}

}  // namespace sslam
