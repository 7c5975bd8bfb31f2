// SPDX-License-Identifier: BSD-3-Clause
// Features of a rolling shutter, whose rows are read one after the other, moved to where they would be seen
// at the frame's stamp: that of the middle row.
#pragma once

#include <vector>

#include "sslam/core/median.hpp"
#include "sslam/geometry/row_offset.hpp"
#include "sslam/map/map.hpp"
#include "sslam/residual/point_reprojection.hpp"
#include "sslam/track/worlds/frame_motion.hpp"

namespace sslam {

// Of what a frame's features see, one over the length unit of the map; 0: far away.
template <Scalar S>
struct InverseDepths {
  std::vector<S> points, lines;  // one for each feature
};

template <Scalar S>
struct RollingShutter {
  double read_out = 0;  // seconds from the first row to the last

  // A static point is seen at d in the middle row's moment and at Exp(xi(t)) d in its own row's; t is known
  // by the row, and xi by the camera's motion.
  [[nodiscard]] Vec2<S> straightened(const Frame<S>& frame, const FrameMotion<S>& motion,
                                     const Vec2<S>& pixel, S inverse_depth) const noexcept {
    if (read_out == 0) return pixel;
    const auto rows = static_cast<S>(frame.height);
    const Vec6<S> moved = motion.until(row_offset(static_cast<S>(read_out), pixel.y(), rows));
    const Vec3<S> ray = frame.pinhole.unproject(pixel) - inverse_depth * moved.template tail<3>();
    const Vec3<S> turned = SO3<S>::exp(Vec3<S>(-moved.template head<3>())) * ray;
    return turned.z() > kMinDepth<S> ? Vec2<S>(frame.pinhole.project(turned)) : pixel;
  }

  // The features of `raw`, straightened, in place of those of `out`, which has as many.
  void straighten(const Frame<S>& raw, const FrameMotion<S>& motion, const InverseDepths<S>& depths,
                  Frame<S>& out) const noexcept {
    for (std::size_t i = 0; i < raw.points.size(); ++i)
      out.points[i].pixel = straightened(raw, motion, raw.points[i].pixel, depths.points[i]);
    for (std::size_t i = 0; i < raw.lines.size(); ++i) {
      const Segment2<S>& seen = raw.lines[i].segment;
      out.lines[i].segment = {straightened(raw, motion, seen.start, depths.lines[i]),
                              straightened(raw, motion, seen.end, depths.lines[i])};
    }
  }
};

// One over the depths of a keyframe's landmarks in `cam_from_world`, for the features of `frame`. Those that
// the keyframe shares with the frame, which it was made of, have their landmark's depth; all others the
// median.
template <Scalar S>
[[nodiscard]] InverseDepths<S> inverse_depths(const Map<S>& map, const Keyframe<S>& keyframe,
                                              const Frame<S>& frame, const SE3<S>& cam_from_world) {
  InverseDepths<S> out;
  out.points.assign(frame.points.size(), 0);
  out.lines.assign(frame.lines.size(), 0);
  const bool same = keyframe.made_of(frame);
  std::vector<S> depths;
  const auto look = [&](const Vec3<S>& position, std::size_t feature, bool own, std::vector<S>& inverse) {
    const S depth = (cam_from_world * position).z();
    if (!(depth > kMinDepth<S>)) return;
    depths.push_back(depth);
    if (own) inverse[feature] = 1 / depth;
  };
  const auto& points = keyframe.point_landmarks;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i] != kNone)
      look(map.points[map.index(points[i])].position, i, same && points.size() == out.points.size(),
           out.points);
  const auto& lines = keyframe.line_landmarks;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i] == kNone) continue;
    const LineLandmark<S>& line = map.lines[map.index(lines[i])];
    look((line.start + line.end) / 2, i, same && lines.size() == out.lines.size(), out.lines);
  }
  const S elsewhere = depths.empty() ? S(0) : 1 / median<S>(depths);
  for (std::vector<S>* features : {&out.points, &out.lines})
    for (S& inverse : *features)
      if (!(inverse > 0)) inverse = elsewhere;
  return out;
}

}  // namespace sslam
