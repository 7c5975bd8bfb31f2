// SPDX-License-Identifier: BSD-3-Clause
// How far a map of a simulated scene is from the truth, how to push it away, and all of its numbers in a row.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "support/map_scene.hpp"

namespace sslam::testing {

// Moves the keyframes from `first` on, and every landmark that lives, off their true places.
template <Scalar S>
void perturb(MapScene& scene, Map<S>& map, std::size_t first, double rotation, double distance) {
  for (std::size_t k = first; k < map.keyframes.size(); ++k) {
    Vec6<double> xi;
    xi << gaussian_vector<3>(scene.random()) * rotation, gaussian_vector<3>(scene.random()) * distance;
    map.keyframes[k].cam_from_world = map.keyframes[k].cam_from_world.retract(xi.cast<S>());
  }
  for (auto& p : map.points) p.position += (gaussian_vector<3>(scene.random()) * distance).cast<S>();
  for (auto& l : map.lines) {
    l.start += (gaussian_vector<3>(scene.random()) * distance).cast<S>();
    l.end += (gaussian_vector<3>(scene.random()) * distance).cast<S>();
    l.line = Line3<S>::from_points(l.start, l.end);
  }
}

[[nodiscard]] inline bool within(double value, double expected, double relative) {
  return std::abs(value - expected) <= relative * std::abs(expected);
}

struct MapErrors {
  double rotation = 0, centre = 0;  // root mean square over the keyframes, degrees and metres
  double point = 0, line = 0;       // median over the landmarks that live, metres
};

[[nodiscard]] inline double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <Scalar S>
[[nodiscard]] MapErrors measure(const MapScene& scene, const Map<S>& map) {
  MapErrors e;
  for (std::size_t k = 0; k < map.keyframes.size(); ++k) {
    const SE3<double> pose = map.keyframes[k].cam_from_world.template cast<double>();
    const double angle = angle_between(pose.rotation, scene.poses[k].rotation);
    e.rotation += angle * angle;
    e.centre += (pose.inverse().translation - scene.poses[k].inverse().translation).squaredNorm();
  }
  const auto n = static_cast<double>(map.keyframes.size());
  e.rotation = degrees(std::sqrt(e.rotation / n));
  e.centre = std::sqrt(e.centre / n);
  std::vector<double> points, lines;
  for (std::size_t i = 0; i < map.points.size(); ++i)
    if (map.points[i].alive)
      points.push_back((map.points[i].position.template cast<double>() - scene.points[i]).norm());
  for (std::size_t i = 0; i < map.lines.size(); ++i) {
    if (!map.lines[i].alive) continue;
    const Vec3<double> middle = (scene.lines[i].start + scene.lines[i].end) / 2;
    lines.push_back((map.lines[i].line.template cast<double>().point_closest_to(middle) - middle).norm());
  }
  e.point = median(points);
  e.line = median(lines);
  return e;
}

[[nodiscard]] inline Map<float> to_float(const Map<double>& map) {
  Map<float> out;
  for (const auto& frame : map.world_from_manhattan) out.world_from_manhattan.push_back(frame.cast<float>());
  for (const auto& p : map.points) out.add_point(p.position.cast<float>(), p.first_keyframe);
  for (const auto& l : map.lines) {
    const auto id =
        out.add_line(l.line.cast<float>(), l.start.cast<float>(), l.end.cast<float>(), l.first_keyframe);
    out.lines[out.index(id)].axis = l.axis;
  }
  for (const auto& from : map.keyframes) {
    Keyframe<float> kf;
    const auto& k = from.frame.pinhole;
    kf.frame.pinhole = {float(k.fx), float(k.fy), float(k.cx), float(k.cy)};
    for (const auto& f : from.frame.points) {
      kf.frame.points.emplace_back();
      kf.frame.points.back().pixel = f.pixel.cast<float>();
      kf.frame.points.back().sigma = float(f.sigma);
    }
    for (const auto& f : from.frame.lines) {
      kf.frame.lines.emplace_back();
      kf.frame.lines.back().segment = {f.segment.start.cast<float>(), f.segment.end.cast<float>()};
      kf.frame.lines.back().sigma = float(f.sigma);
    }
    kf.cam_from_world = from.cam_from_world.cast<float>();
    kf.line_axes = from.line_axes;
    kf.manhattan = {from.manhattan->cam_from_world.cast<float>(), from.manhattan->covariance.cast<float>()};
    out.add_keyframe(std::move(kf).seeing(from.point_landmarks, from.line_landmarks));
  }
  for (auto& p : out.points) p.alive = !p.observations.empty();
  for (auto& l : out.lines) l.alive = !l.observations.empty();
  return out;
}

// Everything that an adjustment may change.
[[nodiscard]] inline std::vector<double> state_of(const Map<double>& map) {
  std::vector<double> out;
  const auto put = [&out](const auto& v) { out.insert(out.end(), v.data(), v.data() + v.size()); };
  for (const auto& kf : map.keyframes) {
    put(kf.cam_from_world.translation);
    put(kf.cam_from_world.rotation.quaternion().coeffs());
    out.insert(out.end(), kf.point_landmarks.begin(), kf.point_landmarks.end());
    out.insert(out.end(), kf.line_landmarks.begin(), kf.line_landmarks.end());
  }
  for (const auto& p : map.points) {
    put(p.position);
    put(p.viewing_direction);
    out.push_back(p.extent);
    out.push_back(static_cast<double>(p.observations.size()));
  }
  for (const auto& l : map.lines) {
    for (const auto& v : {l.line.moment, l.line.direction, l.start, l.end}) put(v);
    out.push_back(l.axis);
    out.push_back(static_cast<double>(l.observations.size()));
  }
  return out;
}

// Same bits, NaN included.
[[nodiscard]] inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace sslam::testing
