// SPDX-License-Identifier: BSD-3-Clause
// The leaves of doors: closed, or ajar, with what is behind.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/synth/decor.hpp"
#include "sslam/synth/floor_space.hpp"
#include "sslam/synth/outline.hpp"
#include "sslam/synth/scene.hpp"

namespace sslam::synth {

struct DoorPaint {
  Paint leaf, handle;

  [[nodiscard]] Paint panel() const {
    Paint darker = leaf;
    darker.colour *= 0.9f;
    return darker;
  }
};

// Set back in its frame, with two panels and a handle.
inline void add_closed_leaf(Scene& scene, const Wall& wall, const Opening& o, const DoorPaint& paint) {
  const double back = -o.depth, face = back + 0.04;
  add_box(scene, wall.place, {o.left, back, o.bottom}, {o.right, face, o.top}, paint.leaf, Sides::kFront);
  for (const double low : {0.15, 1.05}) {
    add_box(scene, wall.place, {o.left + 0.14, face, low}, {o.right - 0.14, face + 0.012, low + 0.75},
            paint.panel());
  }
  add_box(scene, wall.place, {o.left + 0.04, face, 1.0}, {o.left + 0.17, face + 0.05, 1.025}, paint.handle);
}

// How far a door stands open, and which way.
struct Swing {
  double angle;     // radians from closed
  bool left, into;  // the side of the hinge, seen from the room; into the room
  static constexpr double kThick = 0.04;

  // x runs along the leaf, away from a hinge on the left, up to a hinge on the right; y as the wall's.
  [[nodiscard]] FloorArea leaf(const Wall& wall, const Opening& o) const {
    constexpr double kPlay = 0.003;
    const double width = o.right - o.left - 2.0 * kPlay;
    const Vec3<double> hinge =
        wall.place.point(left ? o.left + kPlay : o.right - kPlay, into ? 0.0 : -o.depth, 0.0);
    const double near = into ? -kThick : 0.0;
    return {{hinge.head<2>(), wall.place.yaw + (left == into ? angle : -angle)},
            {left ? 0.0 : -width, near},
            {left ? width : 0.0, near + kThick}};
  }
};

// The leaf as a box turned about its hinge, with panels and handles on both sides.
inline void add_open_leaf(Scene& scene, const FloorArea& leaf, const Opening& o, const DoorPaint& paint) {
  const Vec2<double>&low = leaf.low, &high = leaf.high;
  const bool left = high.x() > 0.0;
  add_box(scene, leaf.place, {low.x(), low.y(), o.bottom + 0.005}, {high.x(), high.y(), o.top - 0.005},
          paint.leaf);
  const auto on_both = [&](double x, double width, double z, double height, double out, const Paint& p) {
    add_box(scene, leaf.place, {x, high.y(), z}, {x + width, high.y() + out, z + height}, p);
    add_box(scene, leaf.place, {x, low.y() - out, z}, {x + width, low.y(), z + height}, p);
  };
  for (const double z : {0.15, 1.05})
    on_both(low.x() + 0.14, high.x() - low.x() - 0.28, z, 0.75, 0.012, paint.panel());
  on_both(left ? high.x() - 0.17 : low.x() + 0.04, 0.13, 1.0, 0.025, 0.05, paint.handle);
}

// A closet behind the opening, so that nobody looks out of the house.
inline void add_recess(Scene& scene, const Wall& wall, const Opening& o, float tone, double light) {
  constexpr double kDeep = 1.2, kBeside = 0.3, kThin = 0.01;
  const double left = o.left - kBeside, right = o.right + kBeside, near = -o.depth, far = near - kDeep;
  const double top = o.top + 0.25, middle = 0.5 * (left + right), half_way = 0.5 * (near + far);
  const Paint paint{Vec3<float>::Constant(tone)}, ground{Vec3<float>::Constant(0.7f * tone)};
  const auto side = [&](const Vec3<double>& low, const Vec3<double>& high, const Paint& p, unsigned sides) {
    add_box(scene, wall.place, low, high, p, sides);
  };
  side({left, far, -kThin}, {right, near, 0.0}, ground, Sides::kTop);
  side({left, far, top}, {right, near, top + kThin}, paint, Sides::kBottom);
  side({left, far - kThin, 0.0}, {right, far, top}, paint, Sides::kFront);
  side({left - kThin, far, 0.0}, {left, near, top}, paint, Sides::kRight);
  side({right, far, 0.0}, {right + kThin, near, top}, paint, Sides::kLeft);
  // The wall's own back, without which the room's lamps would shine through it.
  side({left, near, 0.0}, {o.left, near + kThin, top}, paint, Sides::kBack);
  side({o.right, near, 0.0}, {right, near + kThin, top}, paint, Sides::kBack);
  side({o.left, near, o.top}, {o.right, near + kThin, top}, paint, Sides::kBack);
  if (light == 0.0) return;
  Paint glow{Vec3<float>::Constant(0.99f)};
  glow.glows = true;
  side({middle - 0.1, half_way - 0.1, top - kThin}, {middle + 0.1, half_way + 0.1, top}, glow,
       Sides::kBottom);
  scene.lamps.push_back({wall.place.point(middle, half_way, top - 0.05), 0.1 * wall.place.x_axis(),
                         0.1 * wall.place.y_axis(), -Vec3<double>::UnitZ(), light});
}

// Hangs leaves as the walls are made: closed at once, ajar when it is known where the camera walks.
class DoorHanger {
 public:
  DoorHanger(bool ajar, std::uint64_t seed) : ajar_(ajar), random_(seed) {}

  void hang(Scene& scene, const Wall& wall, const Opening& o, Decor& decor) {
    Paint leaf = decor.furniture();
    DoorPaint paint{std::move(leaf), decor.plain(0.15f, 0.4f)};
    if (ajar_)
      doors_.push_back({wall, o, std::move(paint)});
    else
      add_closed_leaf(scene, wall, o, paint);
  }

  // Into the room only where the path leaves a door its place. Takes that from the floor.
  void open(Scene& scene, FloorSpace& space) {
    for (const Door& door : doors_) {
      Swing swing{};
      swing.angle = radians(random_.uniform(5.0, 70.0));
      swing.left = random_.below(2) == 0;
      swing.into = random_.below(2) == 0;
      const bool lit = random_.below(2) == 0;
      const float tone = lit ? random_.uniform(0.6f, 0.85f) : random_.uniform(0.08f, 0.2f);
      const double light = random_.uniform(0.6, 1.4);
      if (swing.into && !space.free(swing.leaf(door.wall, door.opening))) swing.into = false;
      const FloorArea leaf = swing.leaf(door.wall, door.opening);
      add_recess(scene, door.wall, door.opening, tone, lit ? light : 0.0);
      add_open_leaf(scene, leaf, door.opening, door.paint);
      space.take(leaf);
    }
    doors_.clear();
  }

 private:
  struct Door {
    Wall wall;
    Opening opening;
    DoorPaint paint;
  };

  bool ajar_;
  Random random_;
  std::vector<Door> doors_;
};

}  // namespace sslam::synth
