// SPDX-License-Identifier: BSD-3-Clause
// One plane for each block of a view: semi-global aggregation of the costs (Hirschmueller, PAMI 2008) with
// planes in the place of disparities. A change of plane costs little at an edge of the image, and where the
// two planes meet.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sslam/dense/plane_cost.hpp"

namespace sslam::dense {

inline constexpr std::int16_t kNoPlane = -1;

struct SmoothOptions {
  double change = 0.9;        // cost of another plane in the next block
  double crease = 0.15;       // of one that is at the same depth there
  double at_edge = 0.2;       // at a strong edge, as a part of `change`
  double edge = 20;           // grey values that make an edge strong
  double same_depth = 0.015;  // of two planes, as a part of the depth
};

struct LabelGrid {
  int columns = 0, rows = 0, block = 0;
  std::vector<std::int16_t> plane;   // by block, row by row; kNoPlane: none
  std::vector<float> inverse_depth;  // of it

  // Of the block around a pixel; -1 outside of the grid.
  [[nodiscard]] int block_at(const Vec2<double>& pixel) const noexcept {
    const double x = (pixel.x() + 0.5) / block, y = (pixel.y() + 0.5) / block;
    if (!(x >= 0 && y >= 0 && x < columns && y < rows)) return -1;
    return static_cast<int>(y) * columns + static_cast<int>(x);
  }
};

class LabelSmoother {
 public:
  SmoothOptions options;

  void smooth(const CostGrid& costs, const ImageView<std::uint8_t>& grey, int block, LabelGrid& labels) {
    total_.assign(costs.cost.size(), 0);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (dx != 0 || dy != 0) sweep(costs, grey, block, dx, dy);
    labels.columns = costs.columns;
    labels.rows = costs.rows;
    labels.block = block;
    const auto blocks = static_cast<std::size_t>(costs.columns * costs.rows);
    labels.plane.assign(blocks, kNoPlane);
    labels.inverse_depth.assign(blocks, 0);
    for (std::size_t b = 0; b < blocks; ++b) {
      const float* const first = &total_[b * costs.labels()];
      const auto best = static_cast<std::size_t>(std::min_element(first, first + costs.labels()) - first);
      if (best + 1 == costs.labels()) continue;
      labels.plane[b] = static_cast<std::int16_t>(best);
      labels.inverse_depth[b] = costs.inverse_depth[b * costs.labels() + best];
    }
  }

 private:
  // Along one of eight directions, in an order in which the block before it is done.
  void sweep(const CostGrid& costs, const ImageView<std::uint8_t>& grey, int block, int dx, int dy) {
    path_.assign(costs.cost.size(), 0);
    const bool back = dy < 0 || (dy == 0 && dx < 0);
    for (int i = 0; i < costs.columns * costs.rows; ++i) {
      const int b = back ? costs.columns * costs.rows - 1 - i : i;
      const int c = b % costs.columns, r = b / costs.columns, pc = c - dx, pr = r - dy;
      float* const here = &path_[costs.at(c, r)];
      const float* const cost = &costs.cost[costs.at(c, r)];
      std::copy(cost, cost + costs.labels(), here);
      if (pc >= 0 && pr >= 0 && pc < costs.columns && pr < costs.rows)
        pass(costs, costs.at(pc, pr), costs.at(c, r), change_cost(grey, block, pc, pr, c, r));
      for (std::size_t l = 0; l < costs.labels(); ++l) total_[costs.at(c, r) + l] += here[l];
    }
  }

  // Loops without branches: compilers make vectors of them. What is not seen costs kNoCost, and still does
  // after it.
  void pass(const CostGrid& costs, std::size_t before, std::size_t here, float change) {
    const std::size_t labels = costs.labels();
    const float* const last = &path_[before];
    const float* const inverse = &costs.inverse_depth[here];
    const float least = least_of(last, labels), changed = least + change;
    const auto crease = static_cast<float>(options.crease);
    const auto same = static_cast<float>(options.same_depth);
    best_.resize(labels);
    for (std::size_t l = 0; l < labels; ++l) best_[l] = last[l] < changed ? last[l] : changed;
    // Planes to come from at a crease: the others cost more than any change of plane. `none` has no depth.
    for (std::size_t m = 0; m + 1 < labels; ++m) {
      const float from = inverse[m], cost = last[m] + crease;
      if (!(cost < changed)) continue;
      for (std::size_t l = 0; l < labels; ++l) {
        const float reached = std::abs(from - inverse[l]) < same * inverse[l] ? cost : kNoCost;
        best_[l] = reached < best_[l] ? reached : best_[l];
      }
    }
    float* const path = &path_[here];
    for (std::size_t l = 0; l < labels; ++l) path[l] += best_[l] - least;
  }

  [[nodiscard]] static float least_of(const float* values, std::size_t count) {
    constexpr std::size_t kLanes = 8;
    std::array<float, kLanes> least;
    least.fill(kNoCost);
    std::size_t i = 0;
    for (; i + kLanes <= count; i += kLanes)
      for (std::size_t k = 0; k < kLanes; ++k) least[k] = values[i + k] < least[k] ? values[i + k] : least[k];
    for (; i < count; ++i) least[0] = std::min(least[0], values[i]);
    return *std::min_element(least.begin(), least.end());
  }

  // By the largest step of grey on the way from one block's centre to the next.
  [[nodiscard]] float change_cost(const ImageView<std::uint8_t>& grey, int block, int c0, int r0, int c1,
                                  int r1) const {
    int step = 0, last = -1;
    for (int i = 0; i <= block; ++i) {
      const int x = (c0 * (block - i) + c1 * i) + block / 2, y = (r0 * (block - i) + r1 * i) + block / 2;
      const int value = grey.at(std::min(x, grey.width() - 1), std::min(y, grey.height() - 1));
      if (last >= 0) step = std::max(step, std::abs(value - last));
      last = value;
    }
    const double share = std::min(1.0, step / options.edge);
    return static_cast<float>(options.change * (1 - share * (1 - options.at_edge)));
  }

  std::vector<float> path_, total_, best_;
};

}  // namespace sslam::dense
