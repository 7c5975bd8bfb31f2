// SPDX-License-Identifier: BSD-3-Clause
// A sparse map as ASCII PLY: points as vertices, lines as edges between two vertices each, planes as faces of
// four. Blender, MeshLab and CloudCompare read it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <ostream>
#include <span>
#include <string>

#include "sslam/core/types.hpp"
#include "sslam/io/files/output_file.hpp"

namespace sslam::io {

using Colour = std::array<std::uint8_t, 3>;        // red, green, blue
inline constexpr Colour kNoColour{128, 128, 128};  // of what was seen in no image

struct MapPoint {
  Vec3<double> position;  // world, metres up to the map's scale
  Colour colour = kNoColour;
};

struct MapLine {
  Vec3<double> start;
  Vec3<double> end;
  Colour colour{200, 60, 30};     // of the edge
  Colour end_colour = kNoColour;  // of its two vertices
};

struct MapFace {
  std::array<Vec3<double>, 4> corners;  // in order around it
  Colour colour{120, 120, 120};
};

// `comment`: a line more for the head of the file; empty: none. Throws Error when it cannot be written.
inline void write_map(const std::filesystem::path& path, std::span<const MapPoint> points,
                      std::span<const MapLine> lines, std::span<const MapFace> faces = {},
                      const std::string& comment = {}) {
  OutputFile file(path);
  std::ostream& out = file.stream();
  out << "ply\nformat ascii 1.0\ncomment points first, then start and end of each line, then corners\n";
  if (!comment.empty()) out << "comment " << comment << '\n';
  out << "element vertex " << points.size() + 2 * lines.size() + 4 * faces.size() << "\n"
      << "property float x\nproperty float y\nproperty float z\n"
      << "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      << "element edge " << lines.size() << "\n"
      << "property int vertex1\nproperty int vertex2\n"
      << "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      << "element face " << faces.size() << "\n"
      << "property list uchar int vertex_indices\n"
      << "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
  char row[160];
  const auto write_vertex = [&](const Vec3<double>& p, const Colour& c) {
    std::snprintf(row, sizeof row, "%.6f %.6f %.6f %d %d %d\n", p.x(), p.y(), p.z(), c[0], c[1], c[2]);
    out << row;
  };
  for (const MapPoint& point : points) write_vertex(point.position, point.colour);
  for (const MapLine& line : lines) {
    write_vertex(line.start, line.end_colour);
    write_vertex(line.end, line.end_colour);
  }
  for (const MapFace& face : faces)
    for (const Vec3<double>& corner : face.corners) write_vertex(corner, face.colour);
  std::size_t vertex = points.size();
  for (const MapLine& line : lines) {
    std::snprintf(row, sizeof row, "%zu %zu %d %d %d\n", vertex, vertex + 1, line.colour[0], line.colour[1],
                  line.colour[2]);
    out << row;
    vertex += 2;
  }
  for (const MapFace& face : faces) {
    std::snprintf(row, sizeof row, "4 %zu %zu %zu %zu %d %d %d\n", vertex, vertex + 1, vertex + 2, vertex + 3,
                  face.colour[0], face.colour[1], face.colour[2]);
    out << row;
    vertex += 4;
  }
  file.commit();
}

}  // namespace sslam::io
