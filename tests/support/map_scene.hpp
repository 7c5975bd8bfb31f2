// SPDX-License-Identifier: BSD-3-Clause
// A room of walls, floor and ceiling with points and axis-parallel edges on them, seen by keyframes along a
// path.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/map/map.hpp"
#include "support/random_draws.hpp"

namespace sslam::testing {

struct MapSceneOptions {
  Vec3<double> half{4, 1.5, 3};  // of the room, metres; y down
  int points = 600;
  int lines = 80;
  double pixel_noise = 0.7;
  double farthest = 100;                  // depth to which anything is seen, metres
  double rotation_noise = radians(0.15);  // of a keyframe's Manhattan observation, about each axis
  std::uint64_t seed = 1;
};

struct SceneLine {
  Vec3<double> start, end;
  std::int8_t axis = kNone;
};

class MapScene {
 public:
  MapScene(const MapSceneOptions& options, std::vector<SE3<double>> path)
      : poses(std::move(path)), options_(options), random_(options.seed) {
    for (int i = 0; i < options.points; ++i) points.push_back(on_wall());
    for (int i = 0; i < options.lines; ++i) lines.push_back(edge());
  }

  std::vector<SE3<double>> poses;  // cam_from_world
  std::vector<Vec3<double>> points;
  std::vector<SceneLine> lines;

  // The map with the true geometry and noisy features; landmarks that fewer than two keyframes see are dead.
  [[nodiscard]] Map<double> make_map() {
    Map<double> map = make_landmarks();
    for (std::size_t k = 0; k < poses.size(); ++k) map.add_keyframe(make_keyframe(k, poses[k]));
    for (std::size_t i = 0; i < map.points.size(); ++i)
      if (map.points[i].observations.size() < 2) map.erase_point(static_cast<LandmarkId>(i));
    for (std::size_t i = 0; i < map.lines.size(); ++i)
      if (map.lines[i].observations.size() < 2) map.erase_line(static_cast<LandmarkId>(i));
    for (const Keyframe<double>& kf : map.keyframes) map.update_covisibility(kf.id);
    return map;
  }

  // Every landmark, seen by no keyframe yet.
  [[nodiscard]] Map<double> make_landmarks() const {
    Map<double> map;
    map.world_from_manhattan.emplace_back();
    for (const auto& p : points) map.add_point(p, 0);
    for (const auto& l : lines) {
      const LandmarkId id = map.add_line(Line3<double>::from_points(l.start, l.end), l.start, l.end, 0);
      map.lines[map.index(id)].axis = l.axis;
    }
    return map;
  }

  // What the camera sees from pose k, entered into the map under `believed`.
  [[nodiscard]] Keyframe<double> make_keyframe(std::size_t k, const SE3<double>& believed) {
    Keyframe<double> kf;
    kf.cam_from_world = believed;
    kf.frame.pinhole = {525, 525, 319.5, 239.5};
    kf.frame.width = 640;
    kf.frame.height = 480;
    kf.frame.index = static_cast<std::int64_t>(k);
    std::vector<LandmarkId> seen_points, seen_lines;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (see_point(kf, poses[k], i)) seen_points.push_back(static_cast<LandmarkId>(i));
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (see_line(kf, poses[k], i)) seen_lines.push_back(static_cast<LandmarkId>(i));
    kf.manhattan = RotationObservation<double>{
        SO3<double>::exp(gaussian_vector<3>(random_) * options_.rotation_noise) * poses[k].rotation,
        Mat3<double>::Identity() * options_.rotation_noise * options_.rotation_noise};
    return std::move(kf).seeing(std::move(seen_points), std::move(seen_lines));
  }

  // Enters the room's six sides into the map as planes, with what stands on them as members; a line in a
  // corner goes to one of its two.
  void add_planes(Map<double>& map) const {
    for (std::int8_t axis = 0; axis < 3; ++axis)
      for (const double side : {options_.half[axis], -options_.half[axis]}) {
        const LandmarkId id = map.add_plane({Vec3<double>::Unit(axis), side}, axis);
        for (std::size_t i = 0; i < points.size(); ++i)
          if (map.points[i].alive && points[i][axis] == side) map.points[i].plane = id;
        for (std::size_t i = 0; i < lines.size(); ++i)
          if (map.lines[i].alive && lines[i].start[axis] == side && lines[i].end[axis] == side)
            map.lines[i].plane = id;
      }
  }

  [[nodiscard]] Random& random() { return random_; }

 private:
  [[nodiscard]] Vec3<double> on_wall() {
    const auto& h = options_.half;
    Vec3<double> p = uniform_vector<double, 3>(random_, -1.0, 1.0).cwiseProduct(h);
    const int wall = static_cast<int>(random_.below(6));
    p[wall % 3] = wall < 3 ? h[wall % 3] : -h[wall % 3];
    return p;
  }

  [[nodiscard]] SceneLine edge() {
    SceneLine line;
    line.start = on_wall();
    int wall = 0;
    for (int i = 0; i < 3; ++i)
      if (std::abs(line.start[i]) == options_.half[i]) wall = i;
    const int axis = (wall + 1 + static_cast<int>(random_.below(2))) % 3;
    line.axis = static_cast<std::int8_t>(axis);
    line.end = line.start;
    line.end[axis] += line.start[axis] > 0 ? -1.0 : 1.0;
    return line;
  }

  [[nodiscard]] bool inside(const Keyframe<double>& kf, const Vec3<double>& in_camera) const {
    if (in_camera.z() < 0.3 || in_camera.z() > options_.farthest) return false;
    const Vec2<double> uv = kf.frame.pinhole.project(in_camera);
    return uv.x() > 0 && uv.y() > 0 && uv.x() < kf.frame.width && uv.y() < kf.frame.height;
  }

  bool see_point(Keyframe<double>& kf, const SE3<double>& pose, std::size_t i) {
    const Vec3<double> in_camera = pose * points[i];
    if (!inside(kf, in_camera)) return false;
    PointFeature<double> f;
    f.sigma = options_.pixel_noise;
    f.pixel = kf.frame.pinhole.project(in_camera);
    f.pixel += gaussian_vector<2>(random_) * options_.pixel_noise;
    kf.frame.points.push_back(f);
    return true;
  }

  // Endpoints slide along the segment by some pixels, as a detector's do.
  bool see_line(Keyframe<double>& kf, const SE3<double>& pose, std::size_t i) {
    const Vec3<double> a = pose * lines[i].start, b = pose * lines[i].end;
    if (!inside(kf, a) || !inside(kf, b)) return false;
    const Vec2<double> p = kf.frame.pinhole.project(a), q = kf.frame.pinhole.project(b);
    const double length = (q - p).norm();
    if (length < 20) return false;
    const Vec2<double> along = (q - p) / length, across(-along.y(), along.x());
    const double slide = std::min(5.0, 0.1 * length);
    LineFeature<double> f;
    f.sigma = options_.pixel_noise;
    const Vec2<double> slides = slide * uniform_vector<double, 2>(random_, 0.0, 1.0);
    const Vec2<double> noise = options_.pixel_noise * gaussian_vector<2>(random_);
    f.segment.start = p + slides[0] * along + noise[0] * across;
    f.segment.end = q - slides[1] * along + noise[1] * across;
    kf.frame.lines.push_back(f);
    kf.line_axes.push_back(lines[i].axis);
    return true;
  }

  MapSceneOptions options_;
  Random random_;
};

// A camera at `centre` that looks along the world's z axis turned by yaw about the vertical, then pitched.
[[nodiscard]] inline SE3<double> look(const Vec3<double>& centre, double yaw, double pitch = 0) {
  const auto world_from_cam =
      SO3<double>::exp(Vec3<double>(0, yaw, 0)) * SO3<double>::exp(Vec3<double>(pitch, 0, 0));
  return SE3<double>{world_from_cam, centre}.inverse();
}

// A sweep along the room's long side.
[[nodiscard]] inline std::vector<SE3<double>> sweep(int keyframes, double step = 0.15) {
  std::vector<SE3<double>> path;
  for (int k = 0; k < keyframes; ++k) {
    const double s = k - 0.5 * (keyframes - 1);
    path.push_back(
        look({step * s, 0.1 * std::sin(0.7 * k), -2.2 + 0.05 * std::cos(k)}, 0.03 * s, 0.04 * std::sin(k)));
  }
  return path;
}

}  // namespace sslam::testing
