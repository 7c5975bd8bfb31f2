// SPDX-License-Identifier: BSD-3-Clause
// Walls of a room with doors, windows, skirting boards and pictures.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "sslam/synth/decor.hpp"
#include "sslam/synth/doors.hpp"
#include "sslam/synth/outline.hpp"
#include "sslam/synth/scene.hpp"

namespace sslam::synth {

// One flat piece of the wall; the texture runs on across pieces.
inline void add_wall_piece(Scene& scene, const Wall& wall, double left, double right, double bottom,
                           double top, Paint paint) {
  if (right - left < 1e-6 || top - bottom < 1e-6) return;
  paint.offset += Vec2<float>(static_cast<float>(wall.length - right), static_cast<float>(bottom));
  add_box(scene, wall.place, {left, -0.01, bottom}, {right, 0.0, top}, paint, Sides::kFront);
}

// The four sides of the hole.
inline void add_reveal(Scene& scene, const Wall& wall, const Opening& o, const Paint& paint,
                       const Paint& threshold) {
  constexpr double kThin = 0.01;
  const double back = -o.depth;
  add_box(scene, wall.place, {o.left - kThin, back, o.bottom}, {o.left, 0.0, o.top}, paint, Sides::kRight);
  add_box(scene, wall.place, {o.right, back, o.bottom}, {o.right + kThin, 0.0, o.top}, paint, Sides::kLeft);
  add_box(scene, wall.place, {o.left, back, o.top}, {o.right, 0.0, o.top + kThin}, paint, Sides::kBottom);
  add_box(scene, wall.place, {o.left, back, o.bottom - kThin}, {o.right, 0.0, o.bottom}, threshold,
          Sides::kTop);
}

// The frame that stands out around an opening; a door's has no lower bar.
inline void add_frame(Scene& scene, const Wall& wall, const Opening& o, const Paint& paint) {
  constexpr double kWide = 0.07, kOut = 0.025;
  const bool closed = o.kind == Opening::kWindow;
  const double bottom = closed ? o.bottom - kWide : o.bottom;
  add_box(scene, wall.place, {o.left - kWide, 0.0, bottom}, {o.left, kOut, o.top + kWide}, paint);
  add_box(scene, wall.place, {o.right, 0.0, bottom}, {o.right + kWide, kOut, o.top + kWide}, paint);
  add_box(scene, wall.place, {o.left, 0.0, o.top}, {o.right, kOut, o.top + kWide}, paint);
  if (closed) add_box(scene, wall.place, {o.left, 0.0, bottom}, {o.right, 0.06, o.bottom}, paint);
}

// Glass with the view behind it, a cross of bars, and the daylight that comes in.
inline void add_window_pane(Scene& scene, const Wall& wall, const Opening& o, Decor& decor) {
  const double back = -o.depth, middle = 0.5 * (o.left + o.right), width = o.right - o.left;
  const double height = o.top - o.bottom;
  const Paint view = decor.outdoors(static_cast<float>(width), static_cast<float>(height));
  add_box(scene, wall.place, {o.left, back - 0.01, o.bottom}, {o.right, back, o.top}, view, Sides::kFront);
  const Paint& bar = decor.trim();
  add_box(scene, wall.place, {middle - 0.025, back, o.bottom}, {middle + 0.025, back + 0.05, o.top}, bar);
  const double cross = o.bottom + 0.65 * height;
  add_box(scene, wall.place, {o.left, back, cross - 0.02}, {o.right, back + 0.04, cross + 0.02}, bar);
  scene.lamps.push_back({wall.place.point(middle, 0.05, o.bottom + 0.5 * height),
                         0.5 * width * wall.place.x_axis(),
                         {0.0, 0.0, 0.5 * height},
                         wall.place.y_axis(),
                         decor.random().uniform(0.6, 1.6)});
}

inline void add_skirting(Scene& scene, const Wall& wall, const Paint& paint) {
  constexpr double kHigh = 0.09, kOut = 0.015, kFrame = 0.07;
  double start = 0.0;
  const auto piece = [&](double end) {
    if (end > start) add_box(scene, wall.place, {start, 0.0, 0.0}, {end, kOut, kHigh}, paint);
  };
  for (const Opening& o : wall.openings) {
    if (o.bottom > 0.0) continue;
    piece(o.left - kFrame);
    start = o.right + kFrame;
  }
  piece(wall.length);
}

inline void add_wall(Scene& scene, const Wall& wall, const Paint& paint, const Paint& floor, Decor& decor,
                     DoorHanger& doors) {
  double start = 0.0;
  for (const Opening& o : wall.openings) {
    add_wall_piece(scene, wall, start, o.left, 0.0, wall.height, paint);
    add_wall_piece(scene, wall, o.left, o.right, 0.0, o.bottom, paint);
    add_wall_piece(scene, wall, o.left, o.right, o.top, wall.height, paint);
    start = o.right;
    add_frame(scene, wall, o, decor.trim());
    if (o.depth > 0.0) add_reveal(scene, wall, o, decor.trim(), o.bottom > 0.0 ? decor.trim() : floor);
    if (o.kind == Opening::kDoor) doors.hang(scene, wall, o, decor);
    if (o.kind == Opening::kWindow) add_window_pane(scene, wall, o, decor);
  }
  add_wall_piece(scene, wall, start, wall.length, 0.0, wall.height, paint);
  add_skirting(scene, wall, decor.trim());
}

// Posters in thin frames, or plain boards, where no opening is.
inline void hang_posters(Scene& scene, const Wall& wall, int wanted, Decor& decor) {
  std::vector<std::pair<double, double>> taken;
  for (const Opening& o : wall.openings) taken.emplace_back(o.left - 0.15, o.right + 0.15);
  for (int attempt = 0; attempt < 8 * wanted && wanted > 0; ++attempt) {
    Random& random = decor.random();
    const double width = random.uniform(0.35, 0.95), height = random.uniform(0.4, 0.9);
    if (wall.length < width + 0.5) continue;
    const double left = random.uniform(0.2, wall.length - width - 0.2), bottom = random.uniform(1.0, 1.45);
    const bool free = std::none_of(taken.begin(), taken.end(), [&](const auto& span) {
      return left < span.second && left + width > span.first;
    });
    if (!free) continue;
    taken.emplace_back(left - 0.08, left + width + 0.08);
    const Paint paint = decor.textured() ? decor.poster(static_cast<float>(width), static_cast<float>(height))
                                         : decor.plain(0.55f, 0.95f);
    add_box(scene, wall.place, {left, 0.0, bottom}, {left + width, 0.012, bottom + height}, decor.trim(),
            Sides::kAll & ~Sides::kFront & ~Sides::kBack);
    add_box(scene, wall.place, {left, 0.0, bottom}, {left + width, 0.012, bottom + height}, paint,
            Sides::kFront);
    --wanted;
  }
}

}  // namespace sslam::synth
