// SPDX-License-Identifier: BSD-3-Clause
// A plane with extent, and the line in which it meets another.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "sslam/dense/cell_outline.hpp"
#include "sslam/dense/plane_cells.hpp"
#include "sslam/dense/plane_fit.hpp"
#include "sslam/map/landmark.hpp"

namespace sslam::dense {

struct DensePlane {
  PlaneFit fit;
  std::int8_t axis = kNone;  // number of the Manhattan axis that it is normal to, or kNone
  std::size_t label = 0;     // in DenseModel::labels
  int seen_from = 1;         // the side that most views of it stand on: 1: where the normal points; else -1
  PlaneCells cells;
  std::vector<Polygon> polygons;  // in the cells' two coordinates
};

// The line in which plane `a` meets another, in a's coordinates: normal . u = distance.
struct Crease {
  Vec2<double> normal = Vec2<double>::Zero();  // unit
  double distance = 0;
  const DensePlane* other = nullptr;

  // False where the planes are less than 15 degrees apart: the line is then known badly.
  [[nodiscard]] static bool between(const DensePlane& a, const DensePlane& b, Crease& crease) {
    const Vec2<double> slope = a.cells.basis.transpose() * b.cells.plane.normal;
    const double length = slope.norm();
    if (!(length > 0.26)) return false;
    crease.normal = slope / length;
    crease.distance = -b.cells.plane.offset(a.cells.place(Vec2<double>::Zero())) / length;
    crease.other = &b;
    return true;
  }

  // Signed distance in the plane, positive where the other plane's normal points.
  [[nodiscard]] double offset(const Vec2<double>& u) const { return normal.dot(u) - distance; }
  [[nodiscard]] Vec2<double> nearest(const Vec2<double>& u) const { return u - offset(u) * normal; }

  // Whether the other plane is solid within `reach` cells of a place.
  [[nodiscard]] bool is_real_at(const Vec3<double>& place, int reach) const {
    const PlaneCells& cells = other->cells;
    const Vec2<double> at = (cells.basis.transpose() * place - cells.origin) / cells.cell;
    const int column = static_cast<int>(std::floor(at.x())), row = static_cast<int>(std::floor(at.y()));
    for (int r = row - reach; r <= row + reach; ++r)
      for (int c = column - reach; c <= column + reach; ++c)
        if (cells.is_solid(c, r)) return true;
    return false;
  }
};

}  // namespace sslam::dense
