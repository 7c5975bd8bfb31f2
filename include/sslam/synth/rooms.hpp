// SPDX-License-Identifier: BSD-3-Clause
// Rooms from their walls: floor, ceiling, lamps, windows, doors, posters; and the area left free for walking.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "sslam/synth/decor.hpp"
#include "sslam/synth/doors.hpp"
#include "sslam/synth/house_options.hpp"
#include "sslam/synth/outline.hpp"
#include "sslam/synth/routes.hpp"
#include "sslam/synth/walls.hpp"

namespace sslam::synth {

// A counterclockwise outline for the chosen world.
[[nodiscard]] inline Outline random_outline(World world, Random& random) {
  const double x = random.uniform(5.6, 7.2), y = random.uniform(4.8, 6.0);
  if (world == World::kOblique) {
    const double a = random.uniform(1.4, 2.2), b = a * random.uniform(0.5, 0.8);
    return {{0.0, 0.0}, {x, 0.0}, {x, y - b}, {x - a, y}, {0.0, y}};
  }
  if (world == World::kFree) {
    // A nearly regular pentagon: its headings, modulo 90 degrees, lie as far apart as five can.
    Outline corners;
    const double start = random.uniform(0.0, kTurn), radius = random.uniform(3.4, 3.9);
    for (int i = 0; i < 5; ++i) {
      const double angle = start + kTurn * i / 5, reach = radius * random.uniform(0.97, 1.03);
      corners.push_back({reach * std::cos(angle), reach * std::sin(angle)});
    }
    return corners;
  }
  return rectangle({0.0, 0.0}, {x, y});
}

// A window, a closed door, or both, where the wall is long enough.
inline void add_openings(Wall& wall, bool window, bool door, Random& random) {
  if (window && wall.length > 2.6) {
    const double width = random.uniform(1.1, 1.7);
    const double left = random.uniform(0.4, wall.length - width - 0.4);
    wall.openings.push_back({Opening::kWindow, left, left + width, 0.9, 2.15});
  }
  if (door && wall.length > 2.0) {
    const double left = random.uniform(0.3, wall.length - 1.3);
    wall.openings.push_back({Opening::kDoor, left, left + 0.9, 0.0, 2.05, 0.1});
  }
}

// An ellipse that keeps 1.25 m from every wall, or as much as leaves 0.4 m.
[[nodiscard]] inline FreeArea free_area(const std::vector<Wall>& walls, const Vec2<double>& centre,
                                        Vec2<double> half) {
  for (double scale = 1.0; scale > 0.05; scale *= 0.97) {
    double nearest = 1e9;
    for (int i = 0; i < 72; ++i) {
      const double angle = kTurn * i / 72;
      const Vec2<double> at =
          centre + scale * half.cwiseProduct(Vec2<double>(std::cos(angle), std::sin(angle)));
      for (const Wall& wall : walls) {
        nearest = std::min(nearest, wall.place.y_axis().head<2>().dot(at - wall.place.at));
      }
    }
    if (nearest > 1.25) return {centre, scale * half};
  }
  return {centre, Vec2<double>::Constant(0.4)};
}

inline void add_lamps(Scene& scene, Decor& decor, const Placement& ground, const Vec2<double>& size,
                      double height) {
  const int longer = size.x() > size.y() ? 0 : 1;
  const int count = std::max(1, static_cast<int>(size[longer] / 4.5));
  for (int i = 0; i < count; ++i) {
    Vec2<double> at = size * decor.random().uniform(0.38, 0.62);
    at[longer] = size[longer] * (i + decor.random().uniform(0.35, 0.65)) / count;
    Paint glow{Vec3<float>::Constant(0.99f)};
    glow.glows = true;
    const Vec3<double> half(0.3, 0.15, 0.03), centre(at.x(), at.y(), height - half.z());
    add_box(scene, ground, centre - half, centre + half, decor.trim(),
            Sides::kAll & ~Sides::kBottom & ~Sides::kTop);
    add_box(scene, ground, centre - half, centre + half, glow, Sides::kBottom);
    scene.lamps.push_back({ground.point(centre.x(), centre.y(), height - 0.08),
                           {0.3, 0.0, 0.0},
                           {0.0, 0.15, 0.0},
                           -Vec3<double>::UnitZ(),
                           decor.random().uniform(1.8, 3.2)});
  }
}

// Everything fixed in one room between the corners low and high of its bounding box.
inline void add_room(Scene& scene, Decor& decor, DoorHanger& doors, const std::vector<Wall>& walls,
                     const Vec2<double>& low, const Vec2<double>& high, int posters) {
  const double height = walls.front().height;
  const Vec2<double> size = high - low;
  const Placement ground{low, 0.0};
  const Paint floor = decor.floor(static_cast<float>(size.x()), static_cast<float>(size.y()));
  add_box(scene, ground, {0.0, 0.0, -0.1}, {size.x(), size.y(), 0.0}, floor, Sides::kTop);
  add_box(scene, ground, {0.0, 0.0, height}, {size.x(), size.y(), height + 0.1}, decor.ceiling(),
          Sides::kBottom);
  add_lamps(scene, decor, ground, size, height);
  const float high_wall = static_cast<float>(height);
  for (const Wall& wall : walls) {
    const Paint paint = decor.wall(static_cast<float>(wall.length), high_wall);
    add_wall(scene, wall, paint, floor, decor, doors);
    hang_posters(scene, wall, posters, decor);
  }
}

}  // namespace sslam::synth
