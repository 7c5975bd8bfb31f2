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

// The vertices of a model.ply as `run --dense` writes it: binary, three floats and a colour each.
[[nodiscard]] inline std::vector<Vec3<double>> read_places(const std::filesystem::path& path) {
  constexpr std::size_t kVertex = 3 * sizeof(float) + 3;
  const std::string text = io::read_text(path), words = "element vertex ", end = "end_header\n";
  const std::size_t at = text.find(words), head = text.find(end);
  if (at == std::string::npos || head == std::string::npos || at > head)
    throw Error(path.string() + ": is no model.ply of `sslam run --dense`");
  const std::size_t count = std::strtoull(text.c_str() + at + words.size(), nullptr, 10),
                    first = head + end.size();
  if (count > (text.size() - first) / kVertex) throw Error(path.string() + ": ends before its vertices do");
  std::vector<Vec3<double>> places;
  for (std::size_t i = 0; i < count; ++i) {
    float xyz[3];
    std::memcpy(xyz, text.data() + first + i * kVertex, sizeof xyz);
    places.emplace_back(xyz[0], xyz[1], xyz[2]);
  }
  return places;
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
  using dense_walls_detail::kLevels, dense_walls_detail::kTall;
  std::vector<FloorPlan::Stroke> walls;
  const std::vector<Plane3<double>> planes = dense_walls_detail::planes_of(run);
  const std::filesystem::path file = folder / kModelPlyFile;
  if (planes.empty() || !std::filesystem::exists(file)) return walls;
  std::vector<Vec3<double>> places = dense_walls_detail::read_places(file);
  if (places.empty()) return walls;
  Vec3<double> low = turn * places.front(), high = low;
  for (Vec3<double>& place : places) {
    place = turn * place;
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  const double size = (high - low).head<2>().norm(), height = high.z() - low.z(), step = kStep * size;
  if (!(size > 0 && height > 0)) return walls;
  for (const Plane3<double>& plane : planes) {
    const Vec3<double> normal = turn * plane.normal;
    if (std::abs(normal.z()) > kNearlyUpright) continue;
    const WallAxes axes(normal);
    // What the plane shows at each step along it: a bit for each level of height. Floors that only cross it
    // fill one.
    std::map<long, std::uint32_t> columns;
    for (const Vec3<double>& place : places) {
      if (std::abs(normal.dot(place) - plane.distance) > kThickness * size) continue;
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
