// SPDX-License-Identifier: BSD-3-Clause
// Which views are blurred. Blur takes away what is fine in an image: its Laplacian, beside that of the views
// that see the same things.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "sslam/core/median.hpp"
#include "sslam/dense/dense_view.hpp"

namespace sslam::cli {

// Mean absolute Laplacian over what the view shows of the world; the noise of the camera counts in each view
// alike.
[[nodiscard]] inline double fine_detail(const dense::DenseView& view) {
  double sum = 0;
  std::size_t count = 0;
  for (int y = 1; y + 1 < view.grey.height(); ++y)
    for (int x = 1; x + 1 < view.grey.width(); ++x) {
      if (!view.sees(x, y)) continue;
      sum += std::abs(4 * view.grey.at(x, y) - view.grey.at(x - 1, y) - view.grey.at(x + 1, y) -
                      view.grey.at(x, y - 1) - view.grey.at(x, y + 1));
      ++count;
    }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

// By view: 1 where it is not blurred, 0.3 where it is beyond use.
[[nodiscard]] inline std::vector<double> sharpness_of(std::span<const dense::DenseView> views) {
  constexpr double kBlurred = 0.3;
  std::vector<double> fine, sharpness;
  for (const dense::DenseView& view : views) fine.push_back(fine_detail(view));
  for (std::size_t v = 0; v < views.size(); ++v) {
    std::vector<double> others;
    for (const std::size_t other : views[v].near) others.push_back(fine[other]);
    const double usual = others.empty() ? fine[v] : median(std::span<double>(others));
    sharpness.push_back(usual > 0 ? std::clamp(fine[v] / usual, kBlurred, 1.0) : 1);
  }
  return sharpness;
}

}  // namespace sslam::cli
