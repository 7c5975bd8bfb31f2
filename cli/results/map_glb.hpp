// SPDX-License-Identifier: BSD-3-Clause
// A sparse map as binary glTF: points and lines in the colours in which they were seen, planes as sheets that
// one sees through.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <utility>
#include <vector>

#include "cli/results/gltf_file.hpp"
#include "cli/results/map_colours.hpp"
#include "cli/results/plane_sheets.hpp"
#include "sslam/map/vertical.hpp"

namespace sslam::cli {

struct GlbCounts {
  std::size_t points = 0, lines = 0, planes = 0;
};

namespace map_glb_detail {

using Json = nlohmann::ordered_json;
using Rgba = std::array<std::uint8_t, 4>;

struct Vertices {
  std::vector<Vec3<float>> places;
  std::vector<Rgba> colours;

  void add(const Vec3<double>& place, const io::Colour& c,
           std::uint8_t alpha = std::numeric_limits<std::uint8_t>::max()) {
    places.push_back(place.cast<float>());
    colours.push_back({c[0], c[1], c[2], alpha});
  }
};

// The parts of a mesh, each with accessors of its own.
struct Mesh {
  GltfBuffer buffer;
  Json accessors = Json::array(), primitives = Json::array();

  std::size_t add_accessor(Json accessor) {
    accessors.push_back(std::move(accessor));
    return accessors.size() - 1;
  }

  // mode: of glTF. glTF knows no empty part.
  void add(const Vertices& vertices, int mode, int material, const std::vector<std::uint32_t>& indices = {}) {
    using namespace gltf_names;
    if (vertices.places.empty()) return;
    const std::size_t count = vertices.places.size();
    const std::size_t places = buffer.add(bytes_of(vertices.places), kArrayBuffer);
    const std::size_t colours = buffer.add(bytes_of(vertices.colours), kArrayBuffer);
    Json primitive = {{"mode", mode}, {"material", material}};
    primitive["attributes"]["POSITION"] = add_accessor(places_accessor(places, vertices.places));
    primitive["attributes"]["COLOR_0"] = add_accessor({{"bufferView", colours},
                                                       {"componentType", kByte},
                                                       {"normalized", true},
                                                       {"count", count},
                                                       {"type", "VEC4"}});
    if (!indices.empty()) {
      primitive["indices"] = add_accessor({{"bufferView", buffer.add(bytes_of(indices), kIndexBuffer)},
                                           {"componentType", kUnsigned},
                                           {"count", indices.size()},
                                           {"type", "SCALAR"}});
    }
    primitives.push_back(std::move(primitive));
  }
};

[[nodiscard]] inline Json material(const char* name, const char* alpha_mode) {
  return {{"name", name},
          {"alphaMode", alpha_mode},
          {"doubleSided", true},
          {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
}

}  // namespace map_glb_detail

// In the coordinates of the map; a node turns them to glTF's, y up. The map is not empty. Throws Error when
// it cannot be written.
inline GlbCounts write_map_glb(const std::filesystem::path& path, const Map<double>& map,
                               const MapColours& colours) {
  namespace detail = map_glb_detail;
  constexpr int kPoints = 0, kLines = 1, kTriangles = 4;  // glTF's modes
  GlbCounts counts;
  detail::Vertices points, lines, planes;
  for (std::size_t i = 0; i < map.points.size(); ++i)
    if (map.points[i].alive)
      points.add(map.points[i].position, colour_at(colours.points, i).value_or(io::kNoColour));
  for (std::size_t i = 0; i < map.lines.size(); ++i) {
    const auto& line = map.lines[i];
    if (!line.alive) continue;
    const io::Colour colour = colour_at(colours.lines, i).value_or(io::kNoColour);
    lines.add(line.start, colour);
    lines.add(line.end, colour);
  }
  std::vector<std::uint32_t> triangles;
  for (const PlaneSheet& sheet : plane_sheets(map)) {
    const auto first = static_cast<std::uint32_t>(planes.places.size());
    for (const Vec3<double>& corner : sheet) planes.add(corner, kSheetColour, kSheetAlpha);
    for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) triangles.push_back(first + i);
    ++counts.planes;
  }
  counts.points = points.places.size();
  counts.lines = lines.places.size() / 2;
  detail::Mesh mesh;
  mesh.add(points, kPoints, 0);
  mesh.add(lines, kLines, 0);
  mesh.add(planes, kTriangles, 1, triangles);
  const auto list = [](detail::Json element) { return detail::Json::array({std::move(element)}); };
  detail::Json gltf = {
      {"nodes", list({{"mesh", 0}, {"name", "map"}, {"rotation", turn_to_gltf(up_direction(map))}})},
      {"meshes", list({{"primitives", mesh.primitives}})},
      {"materials",
       detail::Json::array({detail::material("landmarks", "OPAQUE"), detail::material("planes", "BLEND")})},
      {"accessors", mesh.accessors}};
  write_gltf(path, std::move(gltf), mesh.buffer);
  return counts;
}

}  // namespace sslam::cli
