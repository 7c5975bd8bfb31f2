// SPDX-License-Identifier: BSD-3-Clause
// A map as map.ply: points and the ends of lines in the colours in which they were seen, lines and planes in
// those of the Manhattan axes.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/results/map_colours.hpp"
#include "sslam/io/maps/map_writer.hpp"
#include "sslam/map/plane_extent.hpp"

namespace sslam::cli {

// `comment`: for the head of the file. Throws Error when it cannot be written.
inline void write_map_ply(const std::filesystem::path& path, const Map<double>& map,
                          const MapColours& colours, const std::string& comment = {}) {
  constexpr std::array<io::Colour, 4> kAxisColours{
      {{214, 69, 65}, {38, 166, 91}, {65, 131, 215}, {120, 120, 120}}};  // x, y, z, none
  const auto colour_of = [&](std::int8_t axis) {
    return kAxisColours[static_cast<std::size_t>(axis == kNone ? 3 : axis_in_frame(axis))];
  };
  std::vector<io::MapPoint> points;
  for (std::size_t i = 0; i < map.points.size(); ++i)
    if (map.points[i].alive)
      points.push_back({map.points[i].position, colour_at(colours.points, i).value_or(io::kNoColour)});
  std::vector<io::MapLine> lines;
  for (std::size_t i = 0; i < map.lines.size(); ++i)
    if (const auto& line = map.lines[i]; line.alive)
      lines.push_back(
          {line.start, line.end, colour_of(line.axis), colour_at(colours.lines, i).value_or(io::kNoColour)});
  std::vector<io::MapFace> faces;
  std::vector<PlaneExtent<double>> extents;
  gather_extents(map, extents);
  for (std::size_t p = 0; p < extents.size(); ++p)
    if (map.planes[p].alive && extents[p].places > 0)
      faces.push_back({extents[p].corners(map.planes[p].plane), colour_of(map.planes[p].axis)});
  io::write_map(path, points, lines, faces, comment);
}

}  // namespace sslam::cli
