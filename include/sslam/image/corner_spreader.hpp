// SPDX-License-Identifier: BSD-3-Clause
// Spreads corners over an image by a grid: a threshold for each cell, lower where texture is poor, then as
// even a share for each cell as the supply allows.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "sslam/image/image_view.hpp"

namespace sslam {

struct Corner {
  float x = 0, y = 0;  // pixels
  float score = 0;
};

struct SpreadOptions {
  int cell = 32;         // side of a grid cell, pixels
  int budget = 1000;     // corners to keep
  int min_distance = 0;  // between two corners, pixels; the higher score wins
  std::span<const float>
      thresholds;  // of the score, from high to low; a cell uses the first that leaves it enough
  int enough = 3;  // corners a cell should have
};

class CornerSpreader {
 public:
  // Reduces `corners`, which must lie inside an image of this size. The result is in order of cells and
  // falling score, and does not depend on the order of the input.
  void spread(std::vector<Corner>& corners, ImageSize size, const SpreadOptions& options) {
    sort_into_cells(corners, size, options.cell);
    thin_out(size, options);
    share(options.budget, corners);
  }

 private:
  static bool stronger(const Corner& a, const Corner& b) noexcept {
    if (a.score != b.score) return a.score > b.score;
    return a.y != b.y ? a.y < b.y : a.x < b.x;
  }
  [[nodiscard]] std::span<Corner> cell(std::size_t c) noexcept {
    return std::span(sorted_).subspan(starts_[c], starts_[c + 1] - starts_[c]);
  }

  void sort_into_cells(const std::vector<Corner>& corners, ImageSize size, int side) {
    const int columns = (size.width + side - 1) / side, rows = (size.height + side - 1) / side;
    const auto cell_of = [&](const Corner& p) {
      return static_cast<std::size_t>(static_cast<int>(p.y) / side * columns + static_cast<int>(p.x) / side);
    };
    starts_.assign(static_cast<std::size_t>(columns * rows) + 1, 0);
    for (const Corner& corner : corners) ++starts_[cell_of(corner) + 1];
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    counts_.assign(starts_.begin(), starts_.end() - 1);
    sorted_.resize(corners.size());
    for (const Corner& corner : corners) sorted_[counts_[cell_of(corner)]++] = corner;
    for (std::size_t c = 0; c < counts_.size(); ++c) std::sort(cell(c).begin(), cell(c).end(), stronger);
  }

  // Moves the corners that pass to the front of their cell and counts them.
  void thin_out(ImageSize size, const SpreadOptions& options) {
    const int r = options.min_distance;
    const auto stride = static_cast<std::size_t>(size.width);
    if (r > 0) taken_.assign(stride * static_cast<std::size_t>(size.height), 0);
    for (std::size_t c = 0; c < counts_.size(); ++c) {
      const std::span<Corner> corners = cell(c);
      const float threshold = threshold_of(corners, options);
      counts_[c] = 0;
      for (std::size_t i = 0; i < corners.size() && corners[i].score >= threshold; ++i) {
        const int x = static_cast<int>(corners[i].x), y = static_cast<int>(corners[i].y);
        if (r > 0) {
          if (taken_[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)]) continue;
          take_around(x, y, r, size);
        }
        corners[counts_[c]++] = corners[i];
      }
    }
  }

  // Marks the square of half side r, as far as it lies in the image.
  void take_around(int x, int y, int r, ImageSize size) {
    const int left = std::max(x - r, 0), right = std::min(x + r, size.width - 1);
    const int top = std::max(y - r, 0), bottom = std::min(y + r, size.height - 1);
    for (int v = top; v <= bottom; ++v)
      std::fill_n(taken_.begin() + std::ptrdiff_t{v} * size.width + left, right - left + 1, std::uint8_t{1});
  }

  [[nodiscard]] static float threshold_of(std::span<const Corner> corners,
                                          const SpreadOptions& options) noexcept {
    const auto nth = static_cast<std::size_t>(std::max(options.enough - 1, 0));
    for (const float threshold : options.thresholds)
      if (nth < corners.size() && corners[nth].score >= threshold) return threshold;
    return options.thresholds.empty() ? 0.0F : options.thresholds.back();
  }

  // Finds the largest share that every cell may take without passing the budget; what then remains goes to
  // the strongest of the corners next in line.
  void share(int budget, std::vector<Corner>& corners) {
    const auto total = [&](std::size_t limit) {
      std::size_t sum = 0;
      for (const std::size_t count : counts_) sum += std::min(count, limit);
      return sum;
    };
    const auto wanted = static_cast<std::size_t>(std::max(budget, 0));
    std::size_t low = 0, high = wanted + 1;
    while (high - low > 1) {
      const std::size_t middle = (low + high) / 2;
      (total(middle) <= wanted ? low : high) = middle;
    }
    corners.clear();
    next_.clear();
    for (std::size_t c = 0; c < counts_.size(); ++c) {
      const std::span<const Corner> own = cell(c).first(std::min(counts_[c], low));
      corners.insert(corners.end(), own.begin(), own.end());
      if (counts_[c] > low) next_.push_back(cell(c)[low]);
    }
    std::sort(next_.begin(), next_.end(), stronger);
    next_.resize(std::min(next_.size(), wanted - corners.size()));
    corners.insert(corners.end(), next_.begin(), next_.end());
  }

  std::vector<std::size_t> starts_;  // of each cell in sorted_, and the end
  std::vector<std::size_t> counts_;  // corners of each cell that are still in
  std::vector<Corner> sorted_, next_;
  std::vector<std::uint8_t> taken_;  // pixels too near a corner that is in
};

}  // namespace sslam
