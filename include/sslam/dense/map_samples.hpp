// SPDX-License-Identifier: BSD-3-Clause
// The places that a map knows: its points, and its lines as rows of places along them.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "sslam/core/median.hpp"
#include "sslam/map/landmark_precision.hpp"

namespace sslam::dense {

struct MapSample {
  Vec3<double> place = Vec3<double>::Zero();
  Vec3<double> direction = Vec3<double>::Zero();  // of its line, unit; zero for a point
  double sigma = 0;                               // towards the cameras, where it is largest
  LandmarkId landmark = kNone;
  bool line = false;
};

// Standard deviation of the sample along a unit vector, units of the map.
[[nodiscard]] inline double sigma_along(const Map<double>& map, const MapSample& sample,
                                        const Vec3<double>& unit) {
  const std::size_t id = Map<double>::index(sample.landmark);
  return sample.line ? sslam::sigma_along(map, map.lines[id], unit)
                     : sslam::sigma_along(map, map.points[id], unit);
}

// Two unit vectors that span the plane across `normal`, with b0 x b1 = normal; the second follows the
// Manhattan axis that lies in the plane best, if there are any: upright on a wall.
[[nodiscard]] inline Mat<double, 3, 2> plane_basis(const Map<double>& map, const Vec3<double>& normal) {
  Mat<double, 3, 2> basis = tangent_basis(normal);
  double least = 1;
  const int axes = map.world_from_manhattan.empty() ? 0 : 3;
  for (int axis = 0; axis < axes; ++axis) {
    const Vec3<double> along = map.axis(static_cast<std::int8_t>(axis));
    const double slant = std::abs(along.dot(normal));
    if (slant >= least) continue;
    least = slant;
    basis.col(1) = (along - along.dot(normal) * normal).normalized();
    basis.col(0) = basis.col(1).cross(normal);
  }
  return basis;
}

// Middle depth of all landmarks in all keyframes that see them, units of the map; 0 without any.
[[nodiscard]] inline double median_depth(const Map<double>& map) {
  std::vector<double> depths;
  for (const Keyframe<double>& kf : map.keyframes) {
    if (!kf.alive()) continue;
    for (const LandmarkId id : kf.point_landmarks)
      if (id != kNone) depths.push_back((kf.cam_from_world * map.points[map.index(id)].position).z());
    for (const LandmarkId id : kf.line_landmarks)
      if (id != kNone) {
        const LineLandmark<double>& line = map.lines[map.index(id)];
        depths.push_back((kf.cam_from_world * Vec3<double>((line.start + line.end) / 2)).z());
      }
  }
  return depths.empty() ? 0 : std::max(0.0, median(std::span<double>(depths)));
}

// A line has a sample for each `spacing` of its length, two to eight. What only parallel rays see is left
// out.
[[nodiscard]] inline std::vector<MapSample> sample_map(const Map<double>& map, double spacing) {
  std::vector<MapSample> samples;
  const auto towards = [&](const LandmarkCommon& landmark, const Vec3<double>& place) -> Vec3<double> {
    Vec3<double> sum = Vec3<double>::Zero();
    for (const Observation& o : landmark.observations)
      sum += (map.keyframes[map.index(o.keyframe)].cam_from_world.inverse().translation - place).normalized();
    return sum.norm() > 1e-9 ? Vec3<double>(sum.normalized()) : Vec3<double>::UnitZ();
  };
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const PointLandmark<double>& point = map.points[i];
    if (!point.alive || point.observations.size() < 2) continue;
    MapSample sample{.place = point.position, .landmark = static_cast<LandmarkId>(i)};
    sample.sigma = sigma_along(map, sample, towards(point, point.position));
    if (std::isfinite(sample.sigma)) samples.push_back(sample);
  }
  for (std::size_t i = 0; i < map.lines.size(); ++i) {
    const LineLandmark<double>& line = map.lines[i];
    if (!line.alive || line.observations.size() < 2) continue;
    const double length = (line.end - line.start).norm();
    const int count = std::clamp(static_cast<int>(length / spacing), 2, 8);
    MapSample sample{.direction = line.line.direction, .landmark = static_cast<LandmarkId>(i), .line = true};
    Vec3<double> across = towards(line, (line.start + line.end) / 2);
    across -= across.dot(sample.direction) * sample.direction;
    if (!(across.norm() > 1e-6)) continue;
    sample.sigma = sigma_along(map, sample, across.normalized());
    if (!std::isfinite(sample.sigma)) continue;
    for (int k = 0; k < count; ++k) {
      sample.place = line.start + (k + 0.5) / count * (line.end - line.start);
      samples.push_back(sample);
    }
  }
  return samples;
}

}  // namespace sslam::dense
