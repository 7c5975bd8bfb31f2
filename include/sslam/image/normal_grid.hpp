// SPDX-License-Identifier: BSD-3-Clause
// Normals on a regular grid of pixels, and the mask that keeps those on planes: a normal counts as far as its
// neighbours agree with it.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/core/types.hpp"
#include "sslam/image/normal_field.hpp"

namespace sslam {

struct NormalGrid {
  int columns = 0, rows = 0;
  std::vector<Vec3<float>> normal;  // row by row
  std::vector<float> weight;        // 0: none

  void reset(int new_columns, int new_rows) {
    columns = new_columns;
    rows = new_rows;
    normal.assign(static_cast<std::size_t>(columns * rows), Vec3<float>::Zero());
    weight.assign(normal.size(), 0.0F);
  }
};

struct PlanarMaskOptions {
  double max_angle = radians(8.0);  // between a normal and a neighbour that agrees with it
  int min_neighbours = 4;           // of eight, that must agree

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_angle", self.max_angle, Unit::kDegrees, 0, 90,
          "between a normal and a neighbour that agrees with it");
    visit("min_neighbours", self.min_neighbours, Unit::kCount, 0, 8, "of eight, that must agree");
  }
};
static_assert(Described<PlanarMaskOptions>);

// Replaces `field` with the normals of the grid on planar neighbourhoods; each weight is scaled by the share
// of the eight neighbours that agree.
inline void keep_planar(const NormalGrid& grid, const PlanarMaskOptions& options, NormalField& field) {
  field.clear();
  const auto min_cosine = static_cast<float>(std::cos(options.max_angle));
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c) {
      const auto i = static_cast<std::size_t>(r * grid.columns + c);
      if (grid.weight[i] <= 0) continue;
      int agree = 0;
      for (int dr = -1; dr <= 1; ++dr) {
        for (int dc = -1; dc <= 1; ++dc) {
          const int rr = r + dr, cc = c + dc;
          if ((dr == 0 && dc == 0) || rr < 0 || cc < 0 || rr >= grid.rows || cc >= grid.columns) continue;
          const auto j = static_cast<std::size_t>(rr * grid.columns + cc);
          agree += grid.weight[j] > 0 && grid.normal[i].dot(grid.normal[j]) >= min_cosine;
        }
      }
      if (agree < options.min_neighbours) continue;
      const auto& n = grid.normal[i];
      field.push_back(n.x(), n.y(), n.z(), grid.weight[i] * static_cast<float>(agree) / 8.0F);
    }
  }
}

}  // namespace sslam
