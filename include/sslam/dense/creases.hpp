// SPDX-License-Identifier: BSD-3-Clause
// Planes end where they meet: what passes through another plane is cut off, and outlines that nearly reach
// the common line are drawn to it.
#pragma once

#include <cmath>
#include <cstdlib>
#include <vector>

#include "sslam/dense/dense_plane.hpp"

namespace sslam::dense {

struct CreaseOptions {
  int cut = 8;   // cells behind another plane, from the common line on, that are cut off
  int snap = 3;  // cells between an outline and the common line that are closed
};

[[nodiscard]] inline std::vector<Crease> creases_of(const std::vector<DensePlane>& planes, std::size_t p) {
  std::vector<Crease> creases;
  Crease crease;
  for (std::size_t q = 0; q < planes.size(); ++q)
    if (q != p && Crease::between(planes[p], planes[q], crease)) creases.push_back(crease);
  return creases;
}

// Takes solidity from cells that lie just behind another plane, as its views see it.
inline void cut_behind(const std::vector<Crease>& creases, const CreaseOptions& options, PlaneCells& cells) {
  for (const Crease& crease : creases) {
    const double reach = options.cut * cells.cell;
    for (int r = 0; r < cells.rows; ++r)
      for (int c = 0; c < cells.columns; ++c) {
        if (!cells.is_solid(c, r)) continue;
        const Vec2<double> u = cells.corner(c, r) + Vec2<double>::Constant(cells.cell / 2);
        const double behind = -crease.other->seen_from * crease.offset(u);
        if (!(behind > 0 && behind < reach) || !crease.is_real_at(cells.place(crease.nearest(u)), 1))
          continue;
        cells.solid[static_cast<std::size_t>(r * cells.columns + c)] = 0;
      }
  }
}

// Moves corners near a common line on to it, and those near two lines to where these cross.
inline void snap(const std::vector<Crease>& creases, const CreaseOptions& options, const PlaneCells& cells,
                 Ring& ring) {
  const double reach = (options.snap + 0.5) * cells.cell;
  Ring moved;
  for (const Vec2<double>& u : ring) {
    const Crease *first = nullptr, *second = nullptr;
    const auto nearer = [&](const Crease& a, const Crease* b) {
      return b == nullptr || std::abs(a.offset(u)) < std::abs(b->offset(u));
    };
    std::vector<const Crease*> near;
    for (const Crease& crease : creases)
      if (std::abs(crease.offset(u)) < reach &&
          crease.is_real_at(cells.place(crease.nearest(u)), options.snap))
        near.push_back(&crease);
    for (const Crease* const crease : near)
      if (nearer(*crease, first)) first = crease;
    constexpr double kApart = 0.5;  // sine of the angle between two lines that make a corner
    const auto apart = [](const Crease& a, const Crease& b) {
      return std::abs(a.normal.x() * b.normal.y() - a.normal.y() * b.normal.x()) > kApart;
    };
    for (const Crease* const crease : near)
      if (apart(*crease, *first) && nearer(*crease, second)) second = crease;
    Vec2<double> to = first != nullptr ? first->nearest(u) : u;
    if (second != nullptr) {
      const double d = first->normal.x() * second->normal.y() - first->normal.y() * second->normal.x();
      to = Vec2<double>(first->distance * second->normal.y() - second->distance * first->normal.y(),
                        second->distance * first->normal.x() - first->distance * second->normal.x()) /
           d;
    }
    if (moved.empty() || moved.back() != to) moved.push_back(to);
  }
  while (moved.size() > 1 && moved.front() == moved.back()) moved.pop_back();
  ring = std::move(moved);
}

}  // namespace sslam::dense
