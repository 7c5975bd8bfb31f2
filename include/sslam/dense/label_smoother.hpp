// SPDX-License-Identifier: BSD-3-Clause
// One plane for each block of a view: semi-global aggregation of the costs (Hirschmueller, PAMI 2008) with
// planes in the place of disparities. A change of plane costs little at an edge of the image, and where the
// two planes meet.
#pragma once

#include <algorithm>
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
  struct Crossing {
    float inverse_depth, cost;
  };

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

  void pass(const CostGrid& costs, std::size_t before, std::size_t here, float change) {
    const std::size_t labels = costs.labels();
    const float* const last = &path_[before];
    const float least = *std::min_element(last, last + labels);
    const auto crease = static_cast<float>(options.crease);
    const auto same = static_cast<float>(options.same_depth);
    good_.clear();  // planes to come from at a crease: the others cost more than any change of plane
    for (std::size_t m = 0; m + 1 < labels; ++m)
      if (last[m] + crease < least + change)
        good_.push_back({costs.inverse_depth[here + m], last[m] + crease});
    for (std::size_t l = 0; l < labels; ++l) {
      if (costs.cost[here + l] == kNoCost) continue;
      float best = std::min(last[l], least + change);
      const float inverse = costs.inverse_depth[here + l];
      if (l + 1 < labels && best > least + crease)
        for (const Crossing& from : good_)
          if (std::abs(from.inverse_depth - inverse) < same * inverse) best = std::min(best, from.cost);
      path_[here + l] += best - least;
    }
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

  std::vector<float> path_, total_;
  std::vector<Crossing> good_;
};

}  // namespace sslam::dense
