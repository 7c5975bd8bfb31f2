// SPDX-License-Identifier: BSD-3-Clause
// Walls for a floor plan from the model of `--dense`: where its upright planes were seen.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/results/floor_plan.hpp"
#include "cli/results/run_folder.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {

namespace dense_walls_detail {

// A wall shows at so many of the levels of the model's height.
inline constexpr int kLevels = 24, kTall = 8;

// A square of the model.
struct Square {
  Vec3<double> middle, normal;  // normal: unit
};

// Those of a model.ply as `run --dense` writes it: binary, three floats and a colour for each vertex, four of
// these for each square.
[[nodiscard]] inline std::vector<Square> read_squares(const std::filesystem::path& path) {
  constexpr std::size_t kVertex = 3 * sizeof(float) + 3, kFace = 1 + 4 * sizeof(std::int32_t);
  const std::string text = io::read_text(path), end = "end_header\n";
  const std::size_t head = text.find(end), first = head + end.size();
  const auto count = [&](const std::string& words) -> std::size_t {
    const std::size_t at = text.find(words);
    if (at == std::string::npos || head == std::string::npos || at > head)
      throw Error(path.string() + ": is no model.ply of `sslam run --dense`");
    return std::strtoull(text.c_str() + at + words.size(), nullptr, 10);
  };
  const std::size_t vertices = count("element vertex "), faces = count("element face "),
                    left = text.size() - first;
  if (vertices > left / kVertex || faces > (left - vertices * kVertex) / kFace)
    throw Error(path.string() + ": ends before its squares do");
  const auto place = [&](std::size_t i) {
    float xyz[3];
    std::memcpy(xyz, text.data() + first + i * kVertex, sizeof xyz);
    return Vec3<double>(xyz[0], xyz[1], xyz[2]);
  };
  std::vector<Square> squares;
  for (std::size_t f = 0; f < faces; ++f) {
    std::int32_t corner[4];
    std::memcpy(corner, text.data() + first + vertices * kVertex + f * kFace + 1, sizeof corner);
    for (const std::int32_t c : corner)
      if (c < 0 || static_cast<std::size_t>(c) >= vertices)
        throw Error(path.string() + ": a square names a vertex that is not there");
    const auto at = [&](int k) { return place(static_cast<std::size_t>(corner[k])); };
    squares.push_back({(at(0) + at(2)) / 2, (at(2) - at(0)).cross(at(3) - at(1)).normalized()});
  }
  return squares;
}

// Those that metrics.json tells of; none without --dense.
[[nodiscard]] inline std::vector<Plane3<double>> planes_of(const RunFolder& run) {
  std::vector<Plane3<double>> planes;
  const auto dense = run.metrics.find("dense");
  if (dense == run.metrics.end() || !dense->is_object()) return planes;
  try {
    for (const auto& plane : dense->at("planes")) {
      const auto n = plane.at("normal").get<std::array<double, 3>>();
      planes.push_back({{n[0], n[1], n[2]}, plane.at("distance").get<double>()});
    }
  } catch (const nlohmann::json::exception&) {
    throw Error("metrics.json: lacks the planes of --dense (dense: planes)");
  }
  return planes;
}

}  // namespace dense_walls_detail

// `turn`: plan from world. Planes that reach over less than a third of the model's height are furniture.
// Throws Error when model.ply is there and damaged.
[[nodiscard]] inline std::vector<FloorPlan::Stroke> dense_walls(const std::filesystem::path& folder,
                                                                const RunFolder& run,
                                                                const Mat3<double>& turn) {
  constexpr double kThickness = 2e-3, kStep = 0.01;  // shares of the plan
  constexpr double kSameDirection = 0.99;            // cosine
  using dense_walls_detail::kLevels, dense_walls_detail::kTall;
  std::vector<FloorPlan::Stroke> walls;
  const std::vector<Plane3<double>> planes = dense_walls_detail::planes_of(run);
  const std::filesystem::path file = folder / kModelPlyFile;
  if (planes.empty() || !std::filesystem::exists(file)) return walls;
  std::vector<dense_walls_detail::Square> squares = dense_walls_detail::read_squares(file);
  if (squares.empty()) return walls;
  Vec3<double> low = turn * squares.front().middle, high = low;
  for (dense_walls_detail::Square& square : squares) {
    square = {turn * square.middle, turn * square.normal};
    low = low.cwiseMin(square.middle);
    high = high.cwiseMax(square.middle);
  }
  const double size = (high - low).head<2>().norm(), height = high.z() - low.z(), step = kStep * size;
  if (!(size > 0 && height > 0)) return walls;
  for (const Plane3<double>& plane : planes) {
    const Vec3<double> normal = turn * plane.normal;
    if (std::abs(normal.z()) > kNearlyUpright) continue;
    const WallAxes axes(normal);
    // What the plane shows at each step along it: a bit for each level of height.
    std::map<long, std::uint32_t> columns;
    for (const auto& [place, across] : squares) {
      if (std::abs(normal.dot(across)) < kSameDirection ||
          std::abs(normal.dot(place) - plane.distance) > kThickness * size)
        continue;
      const double level = std::min((place.z() - low.z()) / height * kLevels, kLevels - 1.0);
      columns[std::lround(std::floor(axes.along.dot(place) / step))] |= 1U << static_cast<unsigned>(level);
    }
    std::erase_if(columns, [](const auto& column) { return std::popcount(column.second) < kTall; });
    const Vec3<double> foot = axes.across * (plane.distance / axes.across.dot(normal));
    for (auto column = columns.begin(); column != columns.end();) {
      const long first = column->first;
      long last = first;
      for (++column; column != columns.end() && column->first <= last + 2; ++column) last = column->first;
      const auto at = [&](long k) -> Vec3<double> {
        return foot + axes.along * (static_cast<double>(k) * step);
      };
      walls.push_back({at(first), at(last + 1)});
    }
  }
  return walls;
}

}  // namespace sslam::cli
