// SPDX-License-Identifier: BSD-3-Clause
// A map as map.ply: its points, and its lines in the colours of the Manhattan axes.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "sslam/io/map_writer.hpp"
#include "sslam/map/map.hpp"

namespace sslam::cli {

// Throws io::Error when it cannot be written.
inline void write_map_ply(const std::filesystem::path& path, const Map<double>& map) {
  constexpr std::array<io::Colour, 4> kAxisColours{
      {{214, 69, 65}, {38, 166, 91}, {65, 131, 215}, {120, 120, 120}}};  // x, y, z, none
  std::vector<io::MapPoint> points;
  for (const auto& point : map.points)
    if (point.alive) points.push_back({point.position});
  std::vector<io::MapLine> lines;
  for (const auto& line : map.lines)
    if (line.alive)
      lines.push_back(
          {line.start, line.end,
           kAxisColours[static_cast<std::size_t>(line.axis == kNone ? 3 : axis_in_frame(line.axis))]});
  io::write_map(path, points, lines);
}

}  // namespace sslam::cli
