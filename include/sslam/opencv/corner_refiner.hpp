// SPDX-License-Identifier: BSD-3-Clause
// Subpixel place of a corner: the point to which the gradients around it point (Foerstner, Guelch, 1987).
#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>

#include "sslam/core/types.hpp"

namespace sslam {

// Returns the offset from (x, y), pixels; zero where the patch has no single such point within `max_offset`.
// The pixel must lie 4 or more from the border of the 8 bit image.
[[nodiscard]] inline Vec2<double> corner_offset(const cv::Mat& image, int x, int y,
                                                double max_offset) noexcept {
  constexpr int kHalf = 3;
  static constexpr double kWeight[kHalf + 1] = {1, 0.8, 0.41, 0.135};  // Gaussian, sigma 1.5
  const auto stride = static_cast<std::ptrdiff_t>(image.step1());
  double xx = 0, xy = 0, yy = 0, bx = 0, by = 0;
  for (int v = -kHalf; v <= kHalf; ++v) {
    const std::uint8_t* p = image.ptr<std::uint8_t>(y + v) + x;
    for (int u = -kHalf; u <= kHalf; ++u) {
      const double gx = p[u + 1] - p[u - 1], gy = p[u + stride] - p[u - stride];
      const double w = kWeight[std::abs(u)] * kWeight[std::abs(v)];
      const double wxx = w * gx * gx, wxy = w * gx * gy, wyy = w * gy * gy;
      xx += wxx;
      xy += wxy;
      yy += wyy;
      bx += wxx * u + wxy * v;
      by += wxy * u + wyy * v;
    }
  }
  const double det = xx * yy - xy * xy, trace = xx + yy;
  if (det < 0.02 * trace * trace) return Vec2<double>::Zero();  // an edge: the place along it is free
  const Vec2<double> offset((yy * bx - xy * by) / det, (xx * by - xy * bx) / det);
  return offset.norm() <= max_offset ? offset : Vec2<double>::Zero();
}

}  // namespace sslam
