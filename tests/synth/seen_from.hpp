// SPDX-License-Identifier: BSD-3-Clause
// Looks at a house from a place, without light: which pixels show something, and how near things come.
#pragma once

#include <algorithm>
#include <cstddef>

#include "sslam/synth/house.hpp"
#include "sslam/synth/visibility.hpp"

namespace sslam::synth {

inline HouseOptions unlit(std::uint64_t seed) {
  HouseOptions options;
  options.seed = seed;
  options.richness = Richness::kPoor;
  options.lit = false;
  return options;
}

// World z is up.
inline SE3<double> looking(const Vec3<double>& from, const Vec3<double>& to) {
  const Vec3<double> ahead = (to - from).normalized();
  const Vec3<double> right = ahead.cross(Vec3<double>::UnitZ()).normalized();
  Mat3<double> axes;
  axes.col(0) = right;
  axes.col(1) = ahead.cross(right);
  axes.col(2) = ahead;
  SE3<double> pose;
  pose.rotation = SO3<double>::from_matrix(axes);
  pose.translation = from;
  return pose;
}

// How many of 160 x 120 pixels show nothing.
inline std::ptrdiff_t holes(const Scene& scene, const SE3<double>& world_from_cam) {
  Visibility visibility;
  RenderedFrame frame;
  visibility.find(scene, {{90.0, 90.0, 79.5, 59.5}, 160, 120, world_from_cam.inverse()}, frame);
  return std::count(frame.surface.begin(), frame.surface.end(), -1);
}

inline double distance(const Face& face, const Vec3<double>& p) {
  const Vec3<double> d = p - face.origin;
  const double s = std::clamp(face.along_s.dot(d), 0.0, face.width);
  const double t = std::clamp(face.along_t.dot(d), 0.0, face.height);
  return (p - face.at(s, t)).norm();
}

// How near the camera comes to anything on its way.
inline double nearest_to_path(const House& house) {
  double nearest = 1e9;
  for (double t = 0.0; t < house.path.lap_seconds(); t += 0.25) {
    const Vec3<double> camera = house.path.world_from_cam(t).translation;
    for (const Face& face : house.scene.faces) nearest = std::min(nearest, distance(face, camera));
  }
  return nearest;
}

}  // namespace sslam::synth
