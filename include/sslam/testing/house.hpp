// SPDX-License-Identifier: BSD-3-Clause
// Draws up a furnished room, or three rooms along a corridor, and a path through it: everything from one seed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/testing/decor.hpp"
#include "sslam/testing/furniture.hpp"
#include "sslam/testing/lighting.hpp"
#include "sslam/testing/path.hpp"
#include "sslam/testing/routes.hpp"
#include "sslam/testing/scene.hpp"
#include "sslam/testing/walls.hpp"

namespace sslam::synth {

enum class World : std::uint8_t {
  kManhattan,  // every edge along one of three axes
  kTurned,     // Manhattan walls, furniture turned about the vertical
  kOblique,    // one wall cuts a corner at an angle that is neither 0 nor 90 degrees
  kFree,       // vertical walls of which no two are at right angles
};

enum class PathKind : std::uint8_t { kLoop, kSweep, kPivot };

struct HouseOptions {
  std::uint64_t seed = 1;
  Richness richness = Richness::kRich;
  World world = World::kManhattan;
  PathKind path = PathKind::kLoop;  // of a single room; three rooms have a tour
  int rooms = 1;                    // 1 or 3
  float texel = 0.003f;             // metres per texel on walls
  PathOptions motion = {};
  LightingOptions lighting = {};
};

struct House {
  Scene scene;
  ClosedPath path;
};

class HouseBuilder {
 public:
  explicit HouseBuilder(const HouseOptions& options)
      : options_(options),
        random_(options.seed * 0x9E3779B97F4A7C15ULL + 11),
        decor_(scene_, options.richness, options.texel, random_.next()),
        furniture_(scene_, decor_) {}

  template <class ForEach>
  [[nodiscard]] House build(const ForEach& for_each) {
    if (options_.rooms == 3) {
      build_rooms();
    } else {
      build_room();
    }
    ClosedPath path(route_, options_.motion, random_.next());
    for (double t = 0.0; t < path.lap_seconds(); t += 0.1) {
      walked_.push_back(path.world_from_cam(t).translation.head<2>());
    }
    furnish();
    bake_lighting(scene_, options_.lighting, for_each);
    return {std::move(scene_), std::move(path)};
  }

 private:
  using Polygon = std::vector<Vec2<double>>;
  struct Footprint2 {
    Placement place;
    Vec2<double> low, high;  // in the placement's frame
  };
  static constexpr double kWallDepth = 0.12, kClearance = 0.45;

  // Floor, ceiling, lamp and walls of one room; walls[i] runs from corner i to corner i + 1, counterclockwise.
  void add_room(const std::vector<Wall>& walls, const Vec2<double>& low, const Vec2<double>& high, int posters) {
    const double height = walls.front().height;
    const Vec2<double> size = high - low;
    const Placement ground{low, 0.0};
    const Paint floor = decor_.floor(static_cast<float>(size.x()), static_cast<float>(size.y()));
    add_box(scene_, ground, {0.0, 0.0, -0.1}, {size.x(), size.y(), 0.0}, floor, Sides::kTop);
    add_box(scene_, ground, {0.0, 0.0, height}, {size.x(), size.y(), height + 0.1}, decor_.ceiling(), Sides::kBottom);
    add_lamps(ground, size, height);
    const float high_wall = static_cast<float>(height);
    for (const Wall& wall : walls) {
      const Paint paint = decor_.wall(static_cast<float>(wall.length), high_wall);
      add_wall(scene_, wall, paint, floor, decor_);
      if (posters > 0 && decor_.textured()) hang_posters(scene_, wall, posters, decor_);
      walls_.push_back(wall);
    }
  }

  void add_lamps(const Placement& ground, const Vec2<double>& size, double height) {
    const int longer = size.x() > size.y() ? 0 : 1;
    const int count = std::max(1, static_cast<int>(size[longer] / 4.5));
    for (int i = 0; i < count; ++i) {
      Vec2<double> at = size * random_.uniform(0.38, 0.62);
      at[longer] = size[longer] * (i + random_.uniform(0.35, 0.65)) / count;
      Paint glow{Vec3<float>::Constant(0.99f)};
      glow.glows = true;
      const Vec3<double> half(0.3, 0.15, 0.03), centre(at.x(), at.y(), height - half.z());
      add_box(scene_, ground, centre - half, centre + half, decor_.trim(), Sides::kAll & ~Sides::kBottom & ~Sides::kTop);
      add_box(scene_, ground, centre - half, centre + half, glow, Sides::kBottom);
      scene_.lamps.push_back({ground.point(centre.x(), centre.y(), height - 0.08), {0.3, 0.0, 0.0},
                              {0.0, 0.15, 0.0}, -Vec3<double>::UnitZ(), random_.uniform(1.8, 3.2)});
    }
  }

  // A counterclockwise outline for the chosen world.
  [[nodiscard]] Polygon outline() {
    const double x = random_.uniform(5.6, 7.2), y = random_.uniform(4.8, 6.0);
    if (options_.world == World::kOblique) {
      const double a = random_.uniform(1.4, 2.2), b = a * random_.uniform(0.5, 0.8);
      return {{0.0, 0.0}, {x, 0.0}, {x, y - b}, {x - a, y}, {0.0, y}};
    }
    if (options_.world == World::kFree) {
      return {{0.3, 0.0}, {x, 0.9}, {x + 0.4, 0.62 * y}, {0.55 * x, y + 0.5}, {-0.5, 0.7 * y}};
    }
    return {{0.0, 0.0}, {x, 0.0}, {x, y}, {0.0, y}};
  }

  void build_room() {
    const Polygon corners = outline();
    const double height = random_.uniform(2.45, 2.9);
    std::vector<Wall> walls;
    Vec2<double> low = corners[0], high = corners[0], centre = Vec2<double>::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      walls.push_back(wall_between(corners[i], corners[(i + 1) % corners.size()], height));
      low = low.cwiseMin(corners[i]);
      high = high.cwiseMax(corners[i]);
      centre += corners[i] / static_cast<double>(corners.size());
    }
    const std::size_t first = random_.below(static_cast<std::uint32_t>(walls.size()));
    for (std::size_t k = 0; k < walls.size(); ++k) {
      add_openings(walls[(first + k) % walls.size()], k == 0 || k == 2, k == 1);
    }
    add_room(walls, low, high, 3);
    const FreeArea area = free_area(walls, centre, 0.5 * (high - low));
    const double facing = walls[random_.below(static_cast<std::uint32_t>(walls.size()))].place.yaw - 1.2;
    switch (options_.path) {
      case PathKind::kLoop: route_ = loop_route(area, random_); break;
      case PathKind::kSweep: route_ = sweep_route(area, facing, random_); break;
      case PathKind::kPivot: route_ = pivot_route(area, random_); break;
    }
  }

  void add_openings(Wall& wall, bool window, bool door) {
    if (window && wall.length > 2.6) {
      const double width = random_.uniform(1.1, 1.7);
      const double left = random_.uniform(0.4, wall.length - width - 0.4);
      wall.openings.push_back({Opening::kWindow, left, left + width, 0.9, 2.15});
    }
    if (door && wall.length > 2.0) {
      const double left = random_.uniform(0.3, wall.length - 1.3);
      wall.openings.push_back({Opening::kDoor, left, left + 0.9, 0.0, 2.05, 0.1});
    }
  }

  // An ellipse that keeps 1.25 m from every wall, or as much as leaves 0.4 m.
  static FreeArea free_area(const std::vector<Wall>& walls, const Vec2<double>& centre, Vec2<double> half) {
    for (double scale = 1.0; scale > 0.05; scale *= 0.97) {
      double nearest = 1e9;
      for (int i = 0; i < 72; ++i) {
        const double angle = kTurn * i / 72;
        const Vec2<double> at = centre + scale * half.cwiseProduct(Vec2<double>(std::cos(angle), std::sin(angle)));
        for (const Wall& wall : walls) {
          nearest = std::min(nearest, wall.place.y_axis().head<2>().dot(at - wall.place.at));
        }
      }
      if (nearest > 1.25) return {centre, scale * half};
    }
    return {centre, Vec2<double>::Constant(0.4)};
  }

  // A corridor along x and three rooms on its left, each behind an open door.
  void build_rooms() {
    const double height = random_.uniform(2.45, 2.7), deep = 1.8;
    double x = 0.0;
    std::vector<double> left, right, door;
    for (int i = 0; i < 3; ++i) {
      left.push_back(x);
      right.push_back(x + random_.uniform(3.1, 3.6));
      x = right.back() + kWallDepth;
      door.push_back(left[i] + (right[i] - left[i]) * random_.uniform(0.42, 0.58));
    }
    const double length = right.back();
    std::vector<Wall> corridor = rectangle({0.0, 0.0}, {length, deep}, height);
    std::vector<Vec2<double>> there;
    for (int i = 0; i < 3; ++i) {
      const double near = deep + kWallDepth, far = near + random_.uniform(3.3, 3.9);
      std::vector<Wall> room = rectangle({left[i], near}, {right[i], far}, height);
      constexpr double kHalfDoor = 0.5;
      room[0].openings.push_back(
          {Opening::kPassage, door[i] - left[i] - kHalfDoor, door[i] - left[i] + kHalfDoor, 0.0, 2.1, 0.0});
      add_openings(room[2], true, false);
      add_room(room, {left[i], near}, {right[i], far}, 2);
      const double along = length - door[i];  // the corridor's wall 2 runs against x
      corridor[2].openings.insert(corridor[2].openings.begin(),
                                  {Opening::kPassage, along - kHalfDoor, along + kHalfDoor, 0.0, 2.1, kWallDepth});
      for (const Vec2<double>& p : visit(door[i], deep, near, 0.5 * (left[i] + right[i]), far)) there.push_back(p);
    }
    corridor[0].openings.push_back({Opening::kDoor, 0.5 * length, 0.5 * length + 0.9, 0.0, 2.05, 0.1});
    add_openings(corridor[1], false, false);
    add_room(corridor, {0.0, 0.0}, {length, deep}, 3);
    there.insert(there.begin(), {1.2, 0.55 * deep});
    there.push_back({door[2] - 1.5, 0.35 * deep});
    there.push_back({door[0] + 0.5, 0.35 * deep});
    route_ = tour_route(there, random_);
  }

  static std::vector<Wall> rectangle(const Vec2<double>& low, const Vec2<double>& high, double height) {
    const Polygon corners{low, {high.x(), low.y()}, high, {low.x(), high.y()}};
    std::vector<Wall> walls;
    for (std::size_t i = 0; i < 4; ++i) walls.push_back(wall_between(corners[i], corners[(i + 1) % 4], height));
    return walls;
  }

  // From the corridor through the door, once around the room, and out again.
  static Polygon visit(double door, double deep, double near, double middle, double far) {
    const double centre = 0.5 * (near + far) + 0.1, r = 0.6;
    return {{door - 0.5, 0.55 * deep}, {door, deep - 0.4}, {door, near + 0.5}, {middle + r, centre - 0.3},
            {middle + r, centre + r},  {middle - r, centre + r}, {middle - r, centre - 0.3},
            {door, near + 0.5},        {door, deep - 0.4},       {door + 0.5, 0.55 * deep}};
  }

  // Tries pieces along every wall, larger rooms get more; a piece must leave the path and the openings free.
  void furnish() {
    for (const Wall& wall : walls_) {
      const int wanted = wall.length > 5.0 ? 3 : 2;
      for (int attempt = 0, placed = 0; attempt < 14 && placed < wanted; ++attempt) {
        const Piece piece = static_cast<Piece>(random_.below(kPieces));
        Vec3<double> size = random_size(piece, random_);
        if (piece == Piece::kPillar) size.z() = wall.height;
        if (wall.length < size.x() + 0.2) continue;
        const double x = random_.uniform(0.5 * size.x() + 0.02, wall.length - 0.5 * size.x() - 0.02);
        if (place(piece, size, wall, x)) ++placed;
      }
    }
  }

  bool place(Piece piece, const Vec3<double>& size, const Wall& wall, double x) {
    const bool against = piece == Piece::kPillar || (options_.world != World::kTurned && options_.world != World::kFree);
    const double turn = against ? 0.0 : random_.uniform(0.2, 0.8) * (random_.below(2) == 0 ? 1.0 : -1.0);
    const double gap = turn == 0.0 ? 0.02 : 0.02 + 0.5 * size.x() * std::sin(std::abs(turn));
    for (const Opening& o : wall.openings) {
      const bool low_enough = o.kind == Opening::kWindow && size.z() < o.bottom - 0.08 && size.z() > 0.0;
      if (!low_enough && x + 0.5 * size.x() > o.left - 0.12 && x - 0.5 * size.x() < o.right + 0.12) return false;
    }
    const Vec3<double> at = wall.place.point(x, gap, 0.0);
    const Footprint2 footprint{{at.head<2>(), wall.place.yaw + turn}, {-0.5 * size.x(), 0.0}, {0.5 * size.x(), size.y()}};
    for (const Vec2<double>& p : walked_) {
      if (distance(footprint, p) < kClearance) return false;
    }
    for (const Footprint2& other : placed_) {
      if (overlap(footprint, other) || overlap(other, footprint)) return false;
    }
    for (const Wall& other : walls_) {
      if (&other != &wall && pierces(footprint, other)) return false;
    }
    placed_.push_back(footprint);
    furniture_.make(piece, footprint.place, size);
    return true;
  }

  static Vec2<double> corner(const Footprint2& f, double a, double b) {
    return f.place.point(f.low.x() + a * (f.high.x() - f.low.x()), f.low.y() + b * (f.high.y() - f.low.y()), 0.0)
        .head<2>();
  }

  static double distance(const Footprint2& f, const Vec2<double>& p) {
    const Vec2<double> d = p - f.place.at;
    const Vec2<double> local(f.place.x_axis().head<2>().dot(d), f.place.y_axis().head<2>().dot(d));
    return (local - local.cwiseMax(f.low).cwiseMin(f.high)).norm();
  }

  static bool overlap(const Footprint2& a, const Footprint2& b) {
    for (int i = 0; i <= 8; ++i) {
      for (int k = 0; k <= 4; ++k) {
        if (distance(a, corner(b, i / 8.0, k / 4.0)) < 0.06) return true;
      }
    }
    return false;
  }

  // True when the footprint reaches through a wall, or in front of one of its openings.
  static bool pierces(const Footprint2& f, const Wall& wall) {
    for (int i = 0; i < 4; ++i) {
      const Vec2<double> d = corner(f, i & 1, i >> 1) - wall.place.at;
      const double along = wall.place.x_axis().head<2>().dot(d), out = wall.place.y_axis().head<2>().dot(d);
      if (along < -0.2 || along > wall.length + 0.2 || out > 0.5) continue;
      if (out < 0.03 && out > -0.6) return true;
      for (const Opening& o : wall.openings) {
        if (along > o.left - 0.1 && along < o.right + 0.1) return true;
      }
    }
    return false;
  }

  HouseOptions options_;
  Random random_;
  Scene scene_;
  Decor decor_;
  FurnitureMaker furniture_;
  Route route_;
  std::vector<Wall> walls_;
  std::vector<Vec2<double>> walked_;
  std::vector<Footprint2> placed_;
};

// The same options give the same house, bit by bit; for_each as in bake_lighting.
template <class ForEach = InOrder>
[[nodiscard]] House build_house(const HouseOptions& options, const ForEach& for_each = {}) {
  return HouseBuilder(options).build(for_each);
}

}  // namespace sslam::synth
