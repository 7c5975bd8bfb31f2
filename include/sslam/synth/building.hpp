// SPDX-License-Identifier: BSD-3-Clause
// Draws up a floor of many rooms along corridors: cells that see each other through open doors, lit when they
// are first looked at, so that neither a frame nor the first of them costs more in a larger house.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/synth/decor.hpp"
#include "sslam/synth/doors.hpp"
#include "sslam/synth/floor_plan.hpp"
#include "sslam/synth/floor_space.hpp"
#include "sslam/synth/house_options.hpp"
#include "sslam/synth/late_lighting.hpp"
#include "sslam/synth/path.hpp"
#include "sslam/synth/placer.hpp"
#include "sslam/synth/rooms.hpp"
#include "sslam/synth/routes.hpp"

namespace sslam::synth {

class BuildingBuilder {
 public:
  explicit BuildingBuilder(const HouseOptions& options)
      : options_(options),
        random_(options.seed * 0x9E3779B97F4A7C15ULL + 12),
        decor_(scene_, options.richness, options.texel, random_.next()),
        height_(random_.uniform(2.45, 2.7)),
        plan_(plan_floor(options.rooms, random_)) {}

  template <class ForEach>
  [[nodiscard]] House build(const ForEach& for_each) {
    draw_walls();
    for (std::size_t c = 0; c < walls_.size(); ++c) {
      fill(c, [&] {
        const Vec2<double> low = scene_.cells[c].low, high = scene_.cells[c].high;
        add_room(scene_, decor_, doors_, walls_[c], low, high, scene_.cells[c].sill > 0.0 ? 3 : 2);
      });
    }
    const std::uint64_t sway = random_.next();
    ClosedPath path(tour_route(TourPlanner(plan_).tour(), random_), options_.motion, sway);
    furnish(path);
    if (options_.lit) light_late(scene_, options_.lighting, for_each);
    return {std::move(scene_), std::move(path)};
  }

 private:
  using Side = std::size_t;  // of walls_around a rectangle
  static constexpr Side kSouth = 0, kEast = 1, kNorth = 2, kWest = 3;

  void draw_walls() {
    std::size_t cross = 0;
    if (plan_.has_cross()) cross = add_cell(plan_.cross_low, plan_.cross_high, FloorPlan::kWall);
    for (const PlannedCorridor& corridor : plan_.corridors) {
      const std::size_t own = add_cell(corridor.low, corridor.high, FloorPlan::kWall);
      const double middle = 0.5 * (corridor.low.y() + corridor.high.y());
      if (plan_.has_cross())
        join(cross, kEast, own, kWest, {corridor.low.x(), middle});
      else
        add_front_door(walls_[own][kWest]);
      add_front_door(walls_[own][kEast]);
      for (const PlannedRoom& room : corridor.rooms) {
        const std::size_t behind = add_cell(room.low, room.high, 0.0);
        add_openings(walls_[behind][room.left ? kNorth : kSouth], true, false, random_);
        join(own, room.left ? kNorth : kSouth, behind, room.left ? kSouth : kNorth,
             {room.door, room.left ? room.low.y() : room.high.y()});
      }
    }
    for (std::vector<Wall>& room : walls_) {
      for (Wall& wall : room) {
        std::sort(wall.openings.begin(), wall.openings.end(),
                  [](const Opening& a, const Opening& b) { return a.left < b.left; });
      }
    }
  }

  std::size_t add_cell(const Vec2<double>& low, const Vec2<double>& high, double sill) {
    walls_.push_back(walls_around(rectangle(low, high), height_));
    scene_.cells.push_back({low, high, sill});
    return scene_.cells.size() - 1;
  }

  // A closed door at the end of a corridor.
  static void add_front_door(Wall& wall) {
    const double left = 0.5 * wall.length - 0.45;
    wall.openings.push_back({Opening::kDoor, left, left + 0.9, 0.0, 2.05, 0.1});
  }

  // A passage at a place of the inner cell's wall; its sides belong to the outer one.
  void join(std::size_t outer, Side outer_side, std::size_t inner, Side inner_side, const Vec2<double>& at) {
    open(walls_[outer][outer_side], at, FloorPlan::kWall);
    const Wall& wall = walls_[inner][inner_side];
    open(walls_[inner][inner_side], at, 0.0);
    const double middle = along(wall, at), low = middle - FloorPlan::kHalfDoor;
    const double high = middle + FloorPlan::kHalfDoor;
    const auto corner = [&](double x, double z) { return wall.place.point(x, 0.0, z); };
    Doorway door{{corner(low, 0.0), corner(high, 0.0), corner(high, FloorPlan::kDoorHeight),
                  corner(low, FloorPlan::kDoorHeight)},
                 static_cast<std::int32_t>(inner)};
    scene_.cells[outer].doorways.push_back(door);
    door.into = static_cast<std::int32_t>(outer);
    scene_.cells[inner].doorways.push_back(door);
  }
  static void open(Wall& wall, const Vec2<double>& at, double depth) {
    const double middle = along(wall, at);
    wall.openings.push_back({Opening::kPassage, middle - FloorPlan::kHalfDoor, middle + FloorPlan::kHalfDoor,
                             0.0, FloorPlan::kDoorHeight, depth});
  }
  static double along(const Wall& wall, const Vec2<double>& at) {
    return wall.place.x_axis().head<2>().dot(at - wall.place.at);
  }

  // What `work` adds to the scene belongs to the cell.
  template <class Work>
  void fill(std::size_t cell, Work work) {
    const std::size_t face = scene_.faces.size(), lamp = scene_.lamps.size();
    work();
    Cell& filled = scene_.cells[cell];
    for (std::size_t i = face; i < scene_.faces.size(); ++i)
      filled.faces.push_back(static_cast<std::int32_t>(i));
    filled.lamps.insert(filled.lamps.end(), scene_.lamps.begin() + static_cast<std::ptrdiff_t>(lamp),
                        scene_.lamps.end());
  }

  void furnish(const ClosedPath& path) {
    constexpr double kNear = 1.0;  // metres beyond its walls
    std::vector<Vec3<double>> walked;
    for (double t = 0.0; t < path.lap_seconds(); t += 0.1)
      walked.push_back(path.world_from_cam(t).translation);
    const bool turned = options_.world == World::kTurned;
    for (std::size_t c = 0; c < walls_.size(); ++c) {
      std::vector<Vec2<double>> here;
      for (const Vec3<double>& p : walked)
        if (scene_.cells[c].holds(p, kNear)) here.push_back(p.head<2>());
      FloorSpace space(std::move(here));
      fill(c, [&] { FurniturePlacer(scene_, decor_, space, turned, {0.0, 0}).furnish(walls_[c]); });
    }
  }

  HouseOptions options_;
  Random random_;
  Scene scene_;
  Decor decor_;
  double height_;
  FloorPlan plan_;
  DoorHanger doors_{false, 0};
  std::vector<std::vector<Wall>> walls_;  // by cell
};

}  // namespace sslam::synth
