// SPDX-License-Identifier: BSD-3-Clause
// The keyframes of a map as views: where they stand, what they see at which depth, which of them look at the
// same things from elsewhere.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "sslam/dense/dense_view.hpp"
#include "sslam/geometry/resized_camera.hpp"
#include "sslam/map/landmark_precision.hpp"

namespace sslam::dense {

namespace detail {

inline void add_point_marks(const Map<double>& map, const Keyframe<double>& kf, double scale,
                            std::vector<DepthMark>& marks) {
  const Vec3<double> centre = kf.cam_from_world.inverse().translation;
  for (std::size_t i = 0; i < kf.point_landmarks.size(); ++i) {
    if (kf.point_landmarks[i] == kNone) continue;
    const PointLandmark<double>& point = map.points[map.index(kf.point_landmarks[i])];
    const double sigma = sigma_along(map, point, (point.position - centre).normalized());
    const Vec3<double> in_cam = kf.cam_from_world * point.position;
    if (!std::isfinite(sigma) || !(in_cam.z() > 0)) continue;
    marks.push_back({(kf.frame.points[i].pixel.array() + 0.5).matrix() * scale - Vec2<double>::Constant(0.5),
                     in_cam.z(), sigma});
  }
}

// Along what is seen of each line, a mark every `spacing` pixels.
inline void add_line_marks(const Map<double>& map, const Keyframe<double>& kf, double scale, double spacing,
                           std::vector<DepthMark>& marks) {
  const SE3<double> world_from_cam = kf.cam_from_world.inverse();
  for (std::size_t i = 0; i < kf.line_landmarks.size(); ++i) {
    if (kf.line_landmarks[i] == kNone) continue;
    const LineLandmark<double>& line = map.lines[map.index(kf.line_landmarks[i])];
    Vec3<double> across = (line.start + line.end) / 2 - world_from_cam.translation;
    across -= across.dot(line.line.direction) * line.line.direction;
    if (!(across.norm() > 1e-9)) continue;
    const double sigma = sigma_along(map, line, across.normalized());
    if (!std::isfinite(sigma)) continue;
    const Segment2<double>& seen = kf.frame.lines[i].segment;
    const int count = std::max(2, static_cast<int>((seen.end - seen.start).norm() * scale / spacing));
    for (int k = 0; k < count; ++k) {
      const Vec2<double> pixel = seen.start + (k + 0.5) / count * (seen.end - seen.start);
      const Vec3<double> ray = world_from_cam.rotation * kf.frame.pinhole.unproject(pixel).normalized();
      const double z = (kf.cam_from_world * line.line.closest_to_ray(world_from_cam.translation, ray)).z();
      if (z > 0)
        marks.push_back({(pixel.array() + 0.5).matrix() * scale - Vec2<double>::Constant(0.5), z, sigma});
    }
  }
}

}  // namespace detail

// A keyframe without its image; `scale`: size of that image over the size of the one that was tracked.
[[nodiscard]] inline DenseView view_of_keyframe(const Map<double>& map, const Keyframe<double>& kf,
                                                double scale) {
  constexpr double kSpacing = 6;  // of the marks on a line, pixels
  DenseView view;
  view.cam_from_world = kf.cam_from_world;
  view.pinhole = resized(kf.frame.pinhole, scale, scale);
  detail::add_point_marks(map, kf, scale, view.marks);
  detail::add_line_marks(map, kf, scale, kSpacing, view.marks);
  return view;
}

// Fills `near`: of the keyframes that share landmarks, those whose distance comes nearest to what tells depth
// and still looks alike, a seventh of the depth. `ids`: the keyframe of each view.
inline void connect_views(const Map<double>& map, const std::vector<KeyframeId>& ids, double median_depth,
                          std::size_t most, std::vector<DenseView>& views) {
  constexpr double kBaseline = 1.0 / 7;
  std::vector<std::size_t> view_of(map.keyframes.size(), views.size());
  for (std::size_t v = 0; v < ids.size(); ++v) view_of[map.index(ids[v])] = v;
  for (std::size_t v = 0; v < views.size(); ++v) {
    std::vector<std::pair<double, std::size_t>> rated;
    for (const Neighbour& n : map.keyframes[map.index(ids[v])].neighbours) {
      const std::size_t other = view_of[map.index(n.keyframe)];
      if (other == views.size()) continue;
      const double baseline = (views[other].centre() - views[v].centre()).norm() / median_depth;
      if (baseline > 0.01) rated.emplace_back(std::abs(std::log(baseline / kBaseline)), other);
    }
    std::sort(rated.begin(), rated.end());
    views[v].near.clear();
    for (std::size_t i = 0; i < rated.size() && i < most; ++i) views[v].near.push_back(rated[i].second);
  }
}

}  // namespace sslam::dense
