// SPDX-License-Identifier: BSD-3-Clause
// Buckets over the image that answer which point features lie near a pixel.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "sslam/map/frame.hpp"

namespace sslam {

template <Scalar S>
class FeatureGrid {
 public:
  // Counting sort of the features into square cells; keeps its buffers from frame to frame.
  void build(std::span<const PointFeature<S>> points, int width, int height) {
    columns_ = std::max(1, (width + kCell - 1) / kCell);
    rows_ = std::max(1, (height + kCell - 1) / kCell);
    starts_.assign(static_cast<std::size_t>(columns_ * rows_ + 1), 0);
    for (const auto& p : points) ++starts_[cell_of(p.pixel) + 1];
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    cursor_.assign(starts_.begin(), starts_.end() - 1);
    items_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      items_[cursor_[cell_of(points[i].pixel)]++] = static_cast<std::int32_t>(i);
  }

  // Calls visit(index) for every feature in the square of half side `radius` around `pixel`, and a few
  // beyond: the caller checks what it needs.
  template <class Visit>
  void near(const Vec2<S>& pixel, S radius, Visit visit) const {
    if (items_.empty() || !pixel.allFinite()) return;
    const int left = column(pixel.x() - radius), right = column(pixel.x() + radius);
    const int top = row(pixel.y() - radius), bottom = row(pixel.y() + radius);
    for (int r = top; r <= bottom; ++r) {
      const auto first = static_cast<std::size_t>(r * columns_ + left);
      const auto last = static_cast<std::size_t>(r * columns_ + right);
      for (std::uint32_t i = starts_[first]; i < starts_[last + 1]; ++i) visit(items_[i]);
    }
  }

 private:
  static constexpr int kCell = 20;  // pixels

  [[nodiscard]] int column(S u) const noexcept {
    return static_cast<int>(std::clamp<S>(std::floor(u / kCell), 0, static_cast<S>(columns_ - 1)));
  }
  [[nodiscard]] int row(S v) const noexcept {
    return static_cast<int>(std::clamp<S>(std::floor(v / kCell), 0, static_cast<S>(rows_ - 1)));
  }
  [[nodiscard]] std::size_t cell_of(const Vec2<S>& pixel) const noexcept {
    return static_cast<std::size_t>(row(pixel.y()) * columns_ + column(pixel.x()));
  }

  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::uint32_t> starts_{0, 0};  // first item of each cell, and the end
  std::vector<std::uint32_t> cursor_;        // scratch of build
  std::vector<std::int32_t> items_;          // feature indices, cell by cell
};

}  // namespace sslam
