// SPDX-License-Identifier: BSD-3-Clause
// A map from above: walls where it has upright planes, its lines, its points and the camera's path.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sslam/io/plots/comparison_view.hpp"
#include "sslam/map/map.hpp"
#include "sslam/map/vertical.hpp"

namespace sslam::cli {

// In plan coordinates: x and y along the walls, z up, in the unit of the map.
struct FloorPlan {
  struct Stroke {
    Vec3<double> start, end;
  };
  std::vector<Stroke> walls;
  std::vector<Stroke> lines;           // that lie flat
  std::vector<Vec3<double>> uprights;  // lines that stand: where they are
  std::vector<Vec3<double>> points;
  io::Trajectory path;
};

// Rows: the plan's x, y and up, in the world. Walls of a Manhattan world run along x and y.
[[nodiscard]] inline Mat3<double> plan_from_world(const Map<double>& map) {
  const Vec3<double> up = up_direction(map);
  Vec3<double> along = tangent_basis(up).col(0);
  if (!map.world_from_manhattan.empty()) {
    const Mat3<double> axes = map.world_from_manhattan.front().matrix();
    Eigen::Index flattest = 0;
    (axes.transpose() * up).cwiseAbs().minCoeff(&flattest);
    const Vec3<double> axis = axes.col(flattest);
    along = (axis - up * up.dot(axis)).normalized();
  }
  Mat3<double> rows;
  rows << along.transpose(), up.cross(along).transpose(), up.transpose();
  return rows;
}

// In plan coordinates: what lies within 10 degrees of flat or of upright counts as that (a cosine).
inline constexpr double kNearlyUpright = 0.17;

// The level directions across and along a wall, by its normal.
struct WallAxes {
  explicit WallAxes(const Vec3<double>& normal)
      : across(Vec3<double>(normal.x(), normal.y(), 0).normalized()), along(-across.y(), across.x(), 0) {}
  Vec3<double> across, along;
};

namespace floor_plan_detail {

// The stretch of a wall that its landmarks cover; a few of them, which may be wrong, do not count.
inline void add_wall(const Plane3<double>& plane, const Mat3<double>& turn,
                     const std::vector<Vec3<double>>& members, FloorPlan& plan) {
  constexpr std::size_t kFewest = 5;
  constexpr std::size_t kTail = 50;  // one in so many at either end
  if (members.size() < kFewest) return;
  const WallAxes axes(turn * plane.normal);
  std::vector<double> at;
  double sum = 0;
  for (const Vec3<double>& member : members) {
    at.push_back(axes.along.dot(member));
    sum += axes.across.dot(member);
  }
  std::sort(at.begin(), at.end());
  const std::size_t spare = at.size() / kTail;
  const Vec3<double> foot = axes.across * (sum / static_cast<double>(at.size()));
  plan.walls.push_back({foot + axes.along * at[spare], foot + axes.along * at[at.size() - 1 - spare]});
}

inline void draw_strokes(std::ostream& out, const io::svg::View& view,
                         const std::vector<FloorPlan::Stroke>& strokes, const char* style) {
  if (strokes.empty()) return;
  out << "<path fill=\"none\" " << style << " d=\"";
  for (const FloorPlan::Stroke& stroke : strokes) {
    const Vec2<double> a = view(stroke.start), b = view(stroke.end);
    out << io::svg::format("M%.1f %.1fL%.1f %.1f", a.x(), a.y(), b.x(), b.y());
  }
  out << "\"/>\n";
}

// What the page shows: the path and the walls, and of the points all but the few that stray.
[[nodiscard]] inline std::vector<Vec3<double>> shown(const FloorPlan& plan) {
  constexpr std::size_t kTail = 50;
  std::vector<Vec3<double>> all;
  for (const FloorPlan::Stroke& wall : plan.walls) all.insert(all.end(), {wall.start, wall.end});
  if (!plan.points.empty()) {
    Vec3<double> low, high;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> at;
      for (const Vec3<double>& point : plan.points) at.push_back(point[axis]);
      std::sort(at.begin(), at.end());
      low[axis] = at[at.size() / kTail];
      high[axis] = at[at.size() - 1 - at.size() / kTail];
    }
    all.insert(all.end(), {low, high});
  }
  for (const io::StampedPose& pose : plan.path) all.push_back(pose.world_from_cam.translation);
  for (Vec3<double>& place : all) place.z() = 0;  // so that the page's axes are x and y
  return all;
}

}  // namespace floor_plan_detail

[[nodiscard]] inline FloorPlan make_floor_plan(const Map<double>& map, const io::Trajectory& path) {
  namespace detail = floor_plan_detail;
  const double standing = std::sqrt(1 - kNearlyUpright * kNearlyUpright);
  const Mat3<double> turn = plan_from_world(map);
  FloorPlan plan;
  std::vector<std::vector<Vec3<double>>> members(map.planes.size());
  for (const auto& point : map.points) {
    if (!point.alive) continue;
    plan.points.push_back(turn * point.position);
    if (point.plane != kNone) members[map.index(point.plane)].push_back(plan.points.back());
  }
  for (const auto& line : map.lines) {
    if (!line.alive) continue;
    const Vec3<double> start = turn * line.start, end = turn * line.end;
    const double rise = std::abs(end.z() - start.z()), length = (end - start).norm();
    if (rise < kNearlyUpright * length) plan.lines.push_back({start, end});
    if (rise > standing * length) plan.uprights.push_back((start + end) / 2);
    if (line.plane != kNone) {
      members[map.index(line.plane)].push_back(start);
      members[map.index(line.plane)].push_back(end);
    }
  }
  for (std::size_t p = 0; p < map.planes.size(); ++p)
    if (map.planes[p].alive && std::abs((turn * map.planes[p].plane.normal).z()) < kNearlyUpright)
      detail::add_wall(map.planes[p].plane, turn, members[p], plan);
  plan.path = path;
  for (io::StampedPose& pose : plan.path)
    pose.world_from_cam.translation = turn * pose.world_from_cam.translation;
  return plan;
}

// SVG to one scale, whose grid is in `unit`. Throws Error when it cannot be written.
inline void write_floor_plan(const std::filesystem::path& path, const FloorPlan& plan,
                             const std::string& title, const std::string& unit) {
  namespace detail = floor_plan_detail;
  namespace svg = io::svg;
  constexpr const char* kWall = "stroke=\"#222\" stroke-width=\"5\" stroke-linecap=\"round\"";
  constexpr const char* kLine = "stroke=\"#b4552d\" stroke-width=\"1.2\"";
  constexpr const char* kPath = "stroke=\"#1f6fb4\" stroke-width=\"1.8\"";
  const svg::View view = svg::fit(detail::shown(plan), {});
  io::OutputFile file(path);
  std::ostream& out = file.stream();
  svg::begin_page(out, view, unit, title);
  svg::draw_points(out, view, plan.points);
  detail::draw_strokes(out, view, plan.lines, kLine);
  for (const Vec3<double>& upright : plan.uprights) {
    const Vec2<double> at = view(upright);
    out << svg::format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"#b4552d\"/>\n", at.x(), at.y());
  }
  detail::draw_strokes(out, view, plan.walls, kWall);
  svg::draw_path(out, view, plan.path, kPath, io::ordinary_gap(plan.path));
  out << "</g>\n";
  svg::draw_legend(out, svg::kLeft, kWall, "walls");
  svg::draw_legend(out, svg::kLeft + 140, kLine, "lines");
  svg::draw_legend(out, svg::kLeft + 280, kPath, "camera");
  out << "</svg>\n";
  file.commit();
}

}  // namespace sslam::cli
