// SPDX-License-Identifier: BSD-3-Clause
// What a run does to a map that it goes on in: a map that was let in must bear it.
#pragma once

#include "sslam/map/map.hpp"

namespace sslam::fuzzing {

// Landmarks are looked up and fused, keyframes and then all landmarks go, and a copy is joined to what is
// left.
inline void take_apart(Map<double>& map) {
  const Map<double> whole = map;
  (void)map.point_looks();
  (void)map.line_looks();
  for (std::size_t k = 0; k < map.keyframes.size(); ++k)
    if (map.keyframes[k].alive()) map.update_covisibility(static_cast<KeyframeId>(k));
  for (std::size_t i = 0; i + 1 < map.points.size(); i += 2)
    if (map.points[i].alive && map.points[i + 1].alive)
      map.fuse_points(static_cast<LandmarkId>(i), static_cast<LandmarkId>(i + 1));
  for (std::size_t i = 0; i + 1 < map.lines.size(); i += 2)
    if (map.lines[i].alive && map.lines[i + 1].alive)
      map.fuse_lines(static_cast<LandmarkId>(i), static_cast<LandmarkId>(i + 1));
  map = whole;
  for (std::size_t k = 1; k < map.keyframes.size(); ++k)
    if (map.keyframes[k].alive()) map.erase_keyframe(static_cast<KeyframeId>(k), 0);
  for (std::size_t i = 0; i < map.planes.size(); ++i)
    if (map.planes[i].alive) map.erase_plane(static_cast<LandmarkId>(i));
  for (std::size_t i = 0; i < map.points.size(); ++i)
    if (map.points[i].alive) map.erase_point(static_cast<LandmarkId>(i));
  for (std::size_t i = 0; i < map.lines.size(); ++i)
    if (map.lines[i].alive) map.erase_line(static_cast<LandmarkId>(i));
  (void)map.append(whole);
}

}  // namespace sslam::fuzzing
