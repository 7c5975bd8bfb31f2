// SPDX-License-Identifier: BSD-3-Clause
// Subpixel place of a corner: the peak of Harris's measure (Harris, Stephens, 1988), by a parabola over its
// neighbours.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sslam/image/corner_spreader.hpp"
#include "sslam/image/image_view.hpp"

namespace sslam {

class CornerRefiner {
 public:
  static constexpr int kMargin = 6;  // pixels around a corner that are looked at

  // Moves the corner to the peak, with the height of the peak as its score. Returns false, and leaves it
  // alone, where there is no peak within about a pixel. The corner must lie on a pixel that is kMargin or
  // more from the border of the grey image.
  [[nodiscard]] static bool refine(ImageView<std::uint8_t> image, Corner& corner) noexcept {
    const Measure h = harris(image, static_cast<int>(corner.x), static_cast<int>(corner.y));
    std::size_t r = 1, c = 1;
    for (std::size_t i = 1; i + 1 < kSide; ++i)
      for (std::size_t j = 1; j + 1 < kSide; ++j)
        if (h[i][j] > h[r][c]) r = i, c = j;
    if (!(h[r][c] > 0)) return false;
    const float dx = (h[r][c + 1] - h[r][c - 1]) / 2, dy = (h[r + 1][c] - h[r - 1][c]) / 2;
    const float dxx = h[r][c + 1] - 2 * h[r][c] + h[r][c - 1], dyy = h[r + 1][c] - 2 * h[r][c] + h[r - 1][c];
    const float dxy = (h[r + 1][c + 1] - h[r + 1][c - 1] - h[r - 1][c + 1] + h[r - 1][c - 1]) / 4;
    const float det = dxx * dyy - dxy * dxy;
    if (!(det > 0) || !(dxx < 0)) return false;  // a ridge, or the edge of the patch
    const float x = (dxy * dy - dyy * dx) / det, y = (dxy * dx - dxx * dy) / det;
    if (!(std::abs(x) <= 1 && std::abs(y) <= 1)) return false;
    corner.x += static_cast<float>(c) - 2 + x;
    corner.y += static_cast<float>(r) - 2 + y;
    corner.score = h[r][c];
    return true;
  }

 private:
  static constexpr std::size_t kSide = 5;                  // of the patch of measures
  static constexpr std::size_t kTaps = 7;                  // of the window of each
  static constexpr std::size_t kWide = kSide + kTaps - 1;  // of the patch of gradients
  static constexpr std::size_t kRow = 12;                  // kWide, padded for vector registers
  static constexpr std::array<float, kTaps> kWindow{0.135F, 0.411F, 0.801F, 1,
                                                    0.801F, 0.411F, 0.135F};  // sigma 1.5
  static constexpr float kTrace = 0.04F;                                      // weight of the squared trace
  using Measure = std::array<std::array<float, kSide>, kSide>;

  // Products of the gradient, in rows.
  struct Products {
    alignas(16) float xx[kWide][kRow], xy[kWide][kRow], yy[kWide][kRow];
  };

  static void gradients(ImageView<std::uint8_t> image, int x, int y, Products& g) noexcept {
    for (std::size_t r = 0; r < kWide; ++r) {
      const std::uint8_t* b = image.row(y - 5 + static_cast<int>(r)) + x - 6;
      const std::uint8_t* a = b - image.stride();
      const std::uint8_t* d = b + image.stride();
      for (std::size_t c = 0; c < kWide; ++c) {
        const int top = a[c] + 2 * a[c + 1] + a[c + 2], bottom = d[c] + 2 * d[c + 1] + d[c + 2];
        const int west = a[c] + 2 * b[c] + d[c], east = a[c + 2] + 2 * b[c + 2] + d[c + 2];
        const auto gx = static_cast<float>(east - west), gy = static_cast<float>(bottom - top);
        g.xx[r][c] = gx * gx;
        g.xy[r][c] = gx * gy;
        g.yy[r][c] = gy * gy;
      }
      g.xx[r][kWide] = g.xy[r][kWide] = g.yy[r][kWide] = 0;
    }
  }

  static void window(const float (&product)[kWide][kRow], Measure& sum) noexcept {
    for (std::size_t r = 0; r < kSide; ++r) {
      float column[kRow] = {};
      for (std::size_t k = 0; k < kTaps; ++k)
        for (std::size_t c = 0; c < kRow; ++c) column[c] += kWindow[k] * product[r + k][c];
      for (std::size_t c = 0; c < kSide; ++c) {
        sum[r][c] = 0;
        for (std::size_t k = 0; k < kTaps; ++k) sum[r][c] += kWindow[k] * column[c + k];
      }
    }
  }

  [[nodiscard]] static Measure harris(ImageView<std::uint8_t> image, int x, int y) noexcept {
    Products g;
    gradients(image, x, y, g);
    Measure xx, xy, yy;
    window(g.xx, xx);
    window(g.xy, xy);
    window(g.yy, yy);
    Measure h;
    for (std::size_t r = 0; r < kSide; ++r)
      for (std::size_t c = 0; c < kSide; ++c) {
        const float trace = xx[r][c] + yy[r][c];
        h[r][c] = xx[r][c] * yy[r][c] - xy[r][c] * xy[r][c] - kTrace * trace * trace;
      }
    return h;
  }
};

}  // namespace sslam
