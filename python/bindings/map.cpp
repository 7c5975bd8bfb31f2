// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/stl/filesystem.h>

#include <filesystem>

#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "bindings/free.hpp"
#include "bindings/map_arrays.hpp"
#include "sslam/io/maps/map_file.hpp"
#include "sslam/map/plane_extent.hpp"

namespace sslam::python {

PointRows points_of(const Map<double>& map) {
  PointRows rows;
  for (const auto& point : map.points)
    if (point.alive) append(rows.positions, point.position);
  return rows;
}

std::vector<std::uint8_t> colours_of(const Map<double>& map, const cli::MapColours& colours) {
  std::vector<std::uint8_t> values;
  for (std::size_t i = 0; i < map.points.size(); ++i)
    if (map.points[i].alive)
      for (const std::uint8_t value : cli::colour_at(colours.points, i).value_or(io::kNoColour))
        values.push_back(value);
  return values;
}

LineRows lines_of(const Map<double>& map) {
  LineRows rows;
  for (const auto& line : map.lines) {
    if (!line.alive) continue;
    append(rows.ends, line.start);
    append(rows.ends, line.end);
    rows.axis.push_back(line.axis);
  }
  return rows;
}

PlaneRows planes_of(const Map<double>& map) {
  PlaneRows rows;
  std::vector<PlaneExtent<double>> extents;
  gather_extents(map, extents);
  for (std::size_t i = 0; i < extents.size(); ++i) {
    const auto& plane = map.planes[i];
    if (!plane.alive || extents[i].places == 0) continue;
    append(rows.normals, plane.plane.normal);
    rows.distances.push_back(plane.plane.distance);
    for (const Vec3<double>& corner : extents[i].corners(plane.plane)) append(rows.corners, corner);
    rows.axis.push_back(plane.axis);
  }
  return rows;
}

io::Trajectory keyframes_of(const Map<double>& map) {
  io::Trajectory poses;
  for (const auto& keyframe : map.keyframes)
    if (keyframe.alive()) poses.push_back({keyframe.frame.stamp, keyframe.cam_from_world.inverse()});
  return poses;
}

Made<double> arrays_of(PointRows rows) {
  const std::size_t count = rows.positions.size() / 3;
  return make_array(std::move(rows.positions), {count, 3});
}

nb::tuple arrays_of(CloudRows rows) {
  const std::size_t count = rows.colours.size() / 3;
  return nb::make_tuple(arrays_of(std::move(rows.points)), make_array(std::move(rows.colours), {count, 3}));
}

nb::tuple arrays_of(LineRows rows) {
  const std::size_t count = rows.axis.size();
  return nb::make_tuple(make_array(std::move(rows.ends), {count, 2, 3}),
                        make_array(std::move(rows.axis), {count}));
}

nb::tuple arrays_of(PlaneRows rows) {
  const std::size_t count = rows.axis.size();
  return nb::make_tuple(
      make_array(std::move(rows.normals), {count, 3}), make_array(std::move(rows.distances), {count}),
      make_array(std::move(rows.corners), {count, 4, 3}), make_array(std::move(rows.axis), {count}));
}

void bind_map(nb::module_& module) {
  nb::class_<Map<double>>(module, "Map", "A map that was read from a file.")
      .def_static("load",
                  [](const std::filesystem::path& path) {
                    const Free free;
                    return io::load_map(path);
                  })
      .def("points", [](const Map<double>& map) { return arrays_of(points_of(map)); })
      .def("lines", [](const Map<double>& map) { return arrays_of(lines_of(map)); })
      .def("planes", [](const Map<double>& map) { return arrays_of(planes_of(map)); })
      .def("keyframes", [](const Map<double>& map) { return trajectory_arrays(keyframes_of(map)); });
}

}  // namespace sslam::python
