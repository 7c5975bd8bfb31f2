// SPDX-License-Identifier: BSD-3-Clause
// The outline of solid cells as polygons: outer rings counter-clockwise, holes clockwise.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "sslam/core/types.hpp"

namespace sslam::dense {

using Ring = std::vector<Vec2<double>>;  // closed: the last corner is followed by the first

struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
};

// Twice the area within, positive counter-clockwise.
[[nodiscard]] inline double twice_area(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2<double>&a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

// By the parity of the edges to its right.
[[nodiscard]] inline bool inside(const Ring& ring, const Vec2<double>& p) {
  bool in = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2<double>&a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      in = !in;
  }
  return in;
}

// Rings of corners on the grid's lines, solid cells to the left of each edge. `solid(column, row)` is false
// outside of columns x rows. Cells that touch in a corner alone are apart.
template <class Solid>
[[nodiscard]] std::vector<Ring> trace_cells(int columns, int rows, const Solid& solid) {
  // Directions: right, up, left, down. An edge starts in a corner and has its solid cell to the left.
  constexpr std::array<std::array<int, 2>, 4> kStep{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  constexpr std::array<std::array<int, 2>, 4> kLeft{{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
  constexpr std::array<std::array<int, 2>, 4> kRight{{{0, -1}, {0, 0}, {-1, 0}, {-1, -1}}};
  const auto is_edge = [&](int x, int y, int d) {
    const auto k = static_cast<std::size_t>(d);
    return solid(x + kLeft[k][0], y + kLeft[k][1]) && !solid(x + kRight[k][0], y + kRight[k][1]);
  };
  std::vector<std::uint8_t> done(static_cast<std::size_t>((columns + 1) * (rows + 1)), 0);  // bit d: edge d
  const auto mark = [&](int x, int y) -> std::uint8_t& {
    return done[static_cast<std::size_t>(y * (columns + 1) + x)];
  };
  std::vector<Ring> rings;
  for (int y0 = 0; y0 <= rows; ++y0)
    for (int x0 = 0; x0 <= columns; ++x0)
      for (int d0 = 0; d0 < 4; ++d0) {
        if (!is_edge(x0, y0, d0) || (mark(x0, y0) >> d0 & 1) != 0) continue;
        Ring ring;
        int x = x0, y = y0, d = d0;
        do {
          mark(x, y) = static_cast<std::uint8_t>(mark(x, y) | 1 << d);
          ring.emplace_back(x, y);
          x += kStep[static_cast<std::size_t>(d)][0];
          y += kStep[static_cast<std::size_t>(d)][1];
          // Left first, so that cells which touch in a corner stay apart.
          for (const int turn : {1, 0, 3}) {
            const int next = (d + turn) % 4;
            if (!is_edge(x, y, next)) continue;
            d = next;
            break;
          }
        } while (x != x0 || y != y0 || d != d0);
        rings.push_back(std::move(ring));
      }
  return rings;
}

// Rings that do not cross, as polygons: each hole goes to the smallest outer ring around it.
[[nodiscard]] inline std::vector<Polygon> nest(const std::vector<Ring>& rings) {
  std::vector<Polygon> polygons;
  for (const Ring& ring : rings)
    if (ring.size() >= 3 && twice_area(ring) > 0) polygons.push_back({ring, {}});
  for (const Ring& ring : rings) {
    if (ring.size() < 3 || !(twice_area(ring) < 0)) continue;
    Polygon* around = nullptr;
    for (Polygon& polygon : polygons)
      if (inside(polygon.outer, ring.front() * 0.999 + ring[1] * 0.001) &&
          (around == nullptr || twice_area(polygon.outer) < twice_area(around->outer)))
        around = &polygon;
    if (around != nullptr) around->holes.push_back(ring);
  }
  return polygons;
}

}  // namespace sslam::dense
