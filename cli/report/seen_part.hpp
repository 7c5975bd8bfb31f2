// SPDX-License-Identifier: BSD-3-Clause
// Which part of a line of the map its keyframes have seen. The map's own ends keep the farthest that any of
// them ever claimed, and a single flat view of a line puts its end far outside of the room.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "sslam/map/map.hpp"

namespace sslam::cli {

// The ends between which nine tenths of the keyframes have seen it; the map's own where too few of them look
// across it.
[[nodiscard]] inline std::pair<Vec3<double>, Vec3<double>> seen_part(const Map<double>& map,
                                                                     const LineLandmark<double>& line) {
  constexpr double kLeastSine2 = 0.03;  // squared, of the angle between line and ray: 10 degrees
  const Vec3<double>& along = line.line.direction;
  std::vector<double> low, high;
  for (const Observation& o : line.observations) {
    const auto& keyframe = map.keyframes[map.index(o.keyframe)];
    const auto& segment = keyframe.frame.lines[map.index(o.feature)].segment;
    const SE3<double> world_from_cam = keyframe.cam_from_world.inverse();
    const Pinhole<double>& lens = keyframe.frame.pinhole;
    const Vec3<double> from_camera = line.start - world_from_cam.translation;
    std::vector<double> at;
    for (const Vec2<double>& end : {segment.start, segment.end}) {
      const Vec3<double> in_camera((end.x() - lens.cx) / lens.fx, (end.y() - lens.cy) / lens.fy, 1);
      const Vec3<double> ray = (world_from_cam.rotation * in_camera).normalized();
      const double cosine = along.dot(ray), sine2 = 1 - cosine * cosine;
      const double depth = (ray.dot(from_camera) - cosine * along.dot(from_camera)) / sine2;
      if (sine2 < kLeastSine2 || !(depth > 0)) continue;
      at.push_back((cosine * ray.dot(from_camera) - along.dot(from_camera)) / sine2);
    }
    if (at.size() < 2) continue;
    low.push_back(std::min(at[0], at[1]));
    high.push_back(std::max(at[0], at[1]));
  }
  if (low.size() < 2) return {line.start, line.end};
  std::sort(low.begin(), low.end());
  std::sort(high.begin(), high.end());
  const std::size_t left_out = (low.size() + 5) / 10;
  const double first = low[left_out], last = high[high.size() - 1 - left_out];
  if (!(last > first)) return {line.start, line.end};
  return {line.start + first * along, line.start + last * along};
}

}  // namespace sslam::cli
