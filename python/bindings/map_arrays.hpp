// SPDX-License-Identifier: BSD-3-Clause
// What is alive in a map, as numbers in rows.
#pragma once

#include <nanobind/nanobind.h>

#include <cstdint>
#include <vector>

#include "bindings/arrays.hpp"
#include "cli/results/map_colours.hpp"
#include "sslam/io/trajectories/trajectory.hpp"
#include "sslam/map/map.hpp"

namespace sslam::python {

struct PointRows {
  std::vector<double> positions;  // 3 a point
};

struct CloudRows {
  PointRows points;
  std::vector<std::uint8_t> colours;  // 3 a point: red, green, blue
};

// axis: number of the Manhattan axis that a line follows, or that a plane is normal to; -1: none.
struct LineRows {
  std::vector<double> ends;  // 2 x 3 a line
  std::vector<std::int8_t> axis;
};

struct PlaneRows {
  std::vector<double> normals, distances;  // normal . X = distance
  std::vector<double> corners;             // 4 x 3 a plane
  std::vector<std::int8_t> axis;
};

[[nodiscard]] PointRows points_of(const Map<double>& map);
[[nodiscard]] std::vector<std::uint8_t> colours_of(const Map<double>& map, const cli::MapColours& colours);
[[nodiscard]] LineRows lines_of(const Map<double>& map);
[[nodiscard]] PlaneRows planes_of(const Map<double>& map);
// Camera to world, in the order in which they were made.
[[nodiscard]] io::Trajectory keyframes_of(const Map<double>& map);

[[nodiscard]] Made<double> arrays_of(PointRows rows);
[[nodiscard]] nanobind::tuple arrays_of(CloudRows rows);
[[nodiscard]] nanobind::tuple arrays_of(LineRows rows);
[[nodiscard]] nanobind::tuple arrays_of(PlaneRows rows);

}  // namespace sslam::python
