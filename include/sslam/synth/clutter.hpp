// SPDX-License-Identifier: BSD-3-Clause
// Small things at any heading, as people leave them: on the floor along walls, on tables and desks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/synth/decor.hpp"
#include "sslam/synth/floor_space.hpp"
#include "sslam/synth/path.hpp"
#include "sslam/synth/placer.hpp"
#include "sslam/synth/scene.hpp"

namespace sslam::synth {

inline constexpr int kMostClutter = 200;

enum class Thing : std::uint8_t { kBook, kCup, kShoe, kCable };

// Length, width, height; metres.
[[nodiscard]] inline Vec3<double> random_size(Thing thing, Random& random) noexcept {
  const auto between = [&](double x, double to_x, double y, double to_y, double z, double to_z) {
    Vec3<double> size;
    size.x() = random.uniform(x, to_x);
    size.y() = random.uniform(y, to_y);
    size.z() = random.uniform(z, to_z);
    return size;
  };
  switch (thing) {
    case Thing::kBook:
      return between(0.2, 0.3, 0.14, 0.22, 0.015, 0.05);
    case Thing::kCup:
      return between(0.07, 0.09, 0.07, 0.09, 0.08, 0.11);
    case Thing::kShoe:
      return between(0.24, 0.3, 0.09, 0.11, 0.07, 0.12);
    case Thing::kCable:
      return between(0.3, 0.9, 0.008, 0.02, 0.006, 0.012);
  }
  return {0.1, 0.1, 0.1};
}

class ClutterPlacer {
 public:
  ClutterPlacer(Scene& scene, Decor& decor, FloorSpace& space, std::vector<TableTop> tops, std::uint64_t seed)
      : scene_(scene), decor_(decor), space_(space), tops_(std::move(tops)), random_(seed) {}

  // Returns how many found a place.
  int scatter(int count, const std::vector<Wall>& walls) {
    int placed = 0;
    for (int i = 0; i < count; ++i) {
      const bool high = random_.below(3) == 0 && !tops_.empty();
      const Thing thing = static_cast<Thing>(random_.below(high ? 2 : 4));
      const Vec3<double> size = random_size(thing, random_);
      bool found = false;
      for (int attempt = 0; attempt < 40 && !found; ++attempt)
        found = high ? put_on_table(thing, size) : put_on_floor(thing, size, walls);
      placed += found;
    }
    return placed;
  }

 private:
  static FloorArea around(const Vec2<double>& at, double heading, const Vec3<double>& size) {
    const Vec2<double> half = 0.5 * size.head<2>();
    return {{at, heading}, -half, half};
  }

  // Within 0.6 m of a wall.
  bool put_on_floor(Thing thing, const Vec3<double>& size, const std::vector<Wall>& walls) {
    const Wall& wall = walls[random_.below(static_cast<std::uint32_t>(walls.size()))];
    const double x = random_.uniform(0.1, wall.length - 0.1), y = random_.uniform(0.06, 0.6);
    const double heading = random_.uniform(0.0, kTurn);
    const FloorArea area = around(wall.place.point(x, y, 0.0).head<2>(), heading, size);
    const auto hit = [&](const Wall& other) { return pierces(area, other); };
    if (!space_.free(area) || std::any_of(walls.begin(), walls.end(), hit)) return false;
    space_.take(area);
    make(thing, area, 0.0, size.z());
    return true;
  }

  bool put_on_table(Thing thing, const Vec3<double>& size) {
    TableTop& top = tops_[random_.below(static_cast<std::uint32_t>(tops_.size()))];
    const double across = random_.uniform(0.0, 1.0), deep = random_.uniform(0.0, 1.0);
    const double heading = random_.uniform(0.0, kTurn), reach = 0.5 * size.head<2>().norm();
    const FloorArea& area = top.area;
    const Vec2<double> low = area.low.array() + reach, high = area.high.array() - reach;
    if (low.x() > high.x() || low.y() > high.y()) return false;
    const Vec3<double> at = area.place.point(low.x() + across * (high.x() - low.x()),
                                             low.y() + deep * (high.y() - low.y()), top.height);
    for (std::size_t i = top.first_face; i < top.last_face; ++i) {
      if (stands_on(scene_.faces[i], top.height) && beside(scene_.faces[i], at) < reach) return false;
    }
    for (const FloorArea& other : top.things) {
      if ((other.place.at - at.head<2>()).norm() < reach + other.high.norm()) return false;
    }
    top.things.push_back(around(at.head<2>(), heading, size));
    make(thing, top.things.back(), top.height, size.z());
    return true;
  }

  // Whether the face rises above the table's top.
  static bool stands_on(const Face& face, double height) {
    return face.origin.z() + std::max(0.0, face.height * face.along_t.z()) > height + 0.005;
  }
  // Seen from above.
  static double beside(const Face& face, const Vec3<double>& p) {
    const Vec3<double> d = p - face.origin;
    const double s = std::clamp(face.along_s.dot(d), 0.0, face.width);
    const double t = std::clamp(face.along_t.dot(d), 0.0, face.height);
    return (p - face.at(s, t)).head<2>().norm();
  }

  void make(Thing thing, const FloorArea& f, double bottom, double height) {
    const Vec3<double> low(f.low.x(), f.low.y(), bottom), high(f.high.x(), f.high.y(), bottom + height);
    unsigned sides = Sides::kAll & ~Sides::kBottom;
    const Paint paint = thing == Thing::kCable ? decor_.plain(0.05f, 0.9f) : decor_.plain(0.1f, 0.95f);
    if (thing == Thing::kBook && decor_.textured()) {
      sides &= ~Sides::kTop;
      const Vec2<float> cover = (f.high - f.low).cast<float>();
      add_box(scene_, f.place, low, high, decor_.poster(cover.x(), cover.y()), Sides::kTop);
    }
    add_box(scene_, f.place, low, high, paint, sides);
  }

  Scene& scene_;
  Decor& decor_;
  FloorSpace& space_;
  std::vector<TableTop> tops_;
  Random random_;
};

}  // namespace sslam::synth
