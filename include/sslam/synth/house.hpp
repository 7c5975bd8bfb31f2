// SPDX-License-Identifier: BSD-3-Clause
// Draws up a furnished room, three rooms along a corridor, or a floor of many, and a path through it:
// everything from one seed.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/synth/building.hpp"
#include "sslam/synth/clutter.hpp"
#include "sslam/synth/decor.hpp"
#include "sslam/synth/doors.hpp"
#include "sslam/synth/floor_plan.hpp"
#include "sslam/synth/floor_space.hpp"
#include "sslam/synth/house_options.hpp"
#include "sslam/synth/lighting.hpp"
#include "sslam/synth/off_square.hpp"
#include "sslam/synth/path.hpp"
#include "sslam/synth/placer.hpp"
#include "sslam/synth/rooms.hpp"
#include "sslam/synth/routes.hpp"
#include "sslam/synth/scene.hpp"

namespace sslam::synth {

class HouseBuilder {
 public:
  explicit HouseBuilder(const HouseOptions& options)
      : options_(options),
        random_(options.seed * 0x9E3779B97F4A7C15ULL + 11),
        decor_(scene_, options.richness, options.texel, random_.next()),
        off_(options.off_square, own_seed(1)),
        doors_(options.doors_ajar, own_seed(2)) {}

  template <class ForEach>
  [[nodiscard]] House build(const ForEach& for_each) {
    if (options_.rooms == 3) {
      build_rooms();
    } else {
      build_room();
    }
    ClosedPath path(route_, options_.motion, random_.next());
    std::vector<Vec2<double>> walked;
    for (double t = 0.0; t < path.lap_seconds(); t += 0.1) {
      walked.push_back(path.world_from_cam(t).translation.head<2>());
    }
    const bool turned = options_.world == World::kTurned || options_.world == World::kFree;
    FloorSpace space(std::move(walked));
    doors_.open(scene_, space);
    FurniturePlacer furniture(scene_, decor_, space, turned, off_);
    furniture.furnish(walls_);
    if (options_.clutter > 0)
      ClutterPlacer(scene_, decor_, space, furniture.tops(), own_seed(3)).scatter(options_.clutter, walls_);
    if (options_.lit) bake_lighting(scene_, options_.lighting, for_each);
    return {std::move(scene_), std::move(path), std::move(outline_)};
  }

 private:
  void build_room() {
    const Outline square = random_outline(options_.world, random_);
    const Outline& corners = outline_ = options_.off_square > 0.0 ? turned_edges(square, off_) : square;
    const double height = random_.uniform(2.45, 2.9);
    walls_ = walls_around(corners, height);
    Vec2<double> low = corners[0], high = corners[0], centre = Vec2<double>::Zero();
    for (const Vec2<double>& corner : corners) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
      centre += corner / static_cast<double>(corners.size());
    }
    const std::size_t first = random_.below(static_cast<std::uint32_t>(walls_.size()));
    for (std::size_t k = 0; k < walls_.size(); ++k) {
      add_openings(walls_[(first + k) % walls_.size()], k == 0 || k == 2, k == 1, random_);
    }
    add_room(scene_, decor_, doors_, walls_, low, high, 3);
    const FreeArea area = free_area(walls_, centre, 0.5 * (high - low));
    const double facing = walls_[random_.below(static_cast<std::uint32_t>(walls_.size()))].place.yaw - 1.2;
    switch (options_.path) {
      case PathKind::kLoop:
        route_ = loop_route(area, random_);
        break;
      case PathKind::kSweep:
        route_ = sweep_route(area, facing, random_);
        break;
      case PathKind::kPivot:
        route_ = pivot_route(area, random_);
        break;
    }
  }

  // Of what has draws of its own, so that all else stays as it is without it.
  [[nodiscard]] std::uint64_t own_seed(std::uint64_t number) const noexcept {
    return Random(options_.seed ^ (0xD1B54A32D192ED03ULL * number)).next();
  }

  // A corridor along x and three rooms on its left, each behind an open door.
  void build_rooms() {
    const double height = random_.uniform(2.45, 2.7), deep = 1.8;
    double x = 0.0;
    std::vector<double> left, right, door;
    for (int i = 0; i < 3; ++i) {
      left.push_back(x);
      right.push_back(x + random_.uniform(3.6, 4.2));
      x = right.back() + kWallDepth;
      door.push_back(left[i] + (right[i] - left[i]) * random_.uniform(0.42, 0.58));
    }
    const double length = right.back();
    std::vector<Wall> corridor = walls_around(rectangle({0.0, 0.0}, {length, deep}), height);
    std::vector<Vec2<double>> there;
    for (int i = 0; i < 3; ++i) {
      const double near = deep + kWallDepth, far = near + random_.uniform(4.0, 4.8);
      std::vector<Wall> room = walls_around(rectangle({left[i], near}, {right[i], far}), height);
      constexpr double kHalfDoor = 0.5;
      room[0].openings.push_back(
          {Opening::kPassage, door[i] - left[i] - kHalfDoor, door[i] - left[i] + kHalfDoor, 0.0, 2.1, 0.0});
      add_openings(room[2], true, false, random_);
      add_room(scene_, decor_, doors_, room, {left[i], near}, {right[i], far}, 2);
      walls_.insert(walls_.end(), room.begin(), room.end());
      const double along = length - door[i];  // the corridor's wall 2 runs against x
      corridor[2].openings.insert(corridor[2].openings.begin(), {Opening::kPassage, along - kHalfDoor,
                                                                 along + kHalfDoor, 0.0, 2.1, kWallDepth});
      for (const Vec2<double>& p : room_visit(door[i], deep, near, 0.5 * (left[i] + right[i]), far))
        there.push_back(p);
    }
    corridor[0].openings.push_back({Opening::kDoor, 0.5 * length, 0.5 * length + 0.9, 0.0, 2.05, 0.1});
    add_room(scene_, decor_, doors_, corridor, {0.0, 0.0}, {length, deep}, 3);
    walls_.insert(walls_.end(), corridor.begin(), corridor.end());
    there.insert(there.begin(), {1.2, 0.55 * deep});
    there.push_back({door[2] - 1.5, 0.35 * deep});
    there.push_back({door[0] + 0.5, 0.35 * deep});
    route_ = tour_route(there, random_);
  }

  static constexpr double kWallDepth = FloorPlan::kWall;

  HouseOptions options_;
  Random random_;
  Scene scene_;
  Decor decor_;
  OffSquare off_;
  DoorHanger doors_;
  Outline outline_;
  Route route_;
  std::vector<Wall> walls_;
};

// The same options give the same house, bit by bit; for_each as in bake_lighting.
template <class ForEach = InOrder>
[[nodiscard]] House build_house(const HouseOptions& options, const ForEach& for_each = {}) {
  if (options.rooms != 1 && options.rooms != 3) return BuildingBuilder(options).build(for_each);
  return HouseBuilder(options).build(for_each);
}

}  // namespace sslam::synth
