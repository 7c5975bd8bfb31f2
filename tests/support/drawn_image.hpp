// SPDX-License-Identifier: BSD-3-Clause
// Grey images for tests, drawn with exact subpixel edges.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/core/types.hpp"
#include "sslam/image/image_view.hpp"

namespace sslam::testing {

struct DrawnImage {
  ImageSize size;
  std::vector<std::uint8_t> pixels;  // row by row

  explicit DrawnImage(ImageSize of, std::uint8_t grey = 0)
      : size(of), pixels(static_cast<std::size_t>(of.width * of.height), grey) {}

  [[nodiscard]] ImageView<std::uint8_t> view() const { return {pixels.data(), size}; }
};

[[nodiscard]] inline std::uint8_t grey_level(double value) {
  return static_cast<std::uint8_t>(std::clamp(std::lrint(value), 0L, 255L));
}

// shade(x, y), grey levels, averaged over 64 places in each pixel, no two of them in one column or row.
template <class Shade>
DrawnImage draw(ImageSize size, Shade shade) {
  constexpr int kSide = 8;
  DrawnImage image(size);
  auto pixel = image.pixels.begin();
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u, ++pixel) {
      double sum = 0;
      for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
          const double x = (i + (j + 0.5) / kSide) / kSide - 0.5, y = (j + (i + 0.5) / kSide) / kSide - 0.5;
          sum += shade(u + x, v + y);
        }
      *pixel = grey_level(sum / (kSide * kSide));
    }
  return image;
}

// A box with these corners, turned by `angle` about its middle.
inline DrawnImage draw_box(ImageSize size, const Vec2<double>& low, const Vec2<double>& high, double angle,
                           double inside, double outside) {
  const Vec2<double> middle = (low + high) / 2, half = (high - low) / 2;
  const double c = std::cos(angle), s = std::sin(angle);
  return draw(size, [&](double x, double y) {
    const double dx = x - middle.x(), dy = y - middle.y();
    return std::abs(c * dx + s * dy) < half.x() && std::abs(c * dy - s * dx) < half.y() ? inside : outside;
  });
}

inline void add_noise(std::span<std::uint8_t> pixels, double sigma, std::uint64_t seed) {
  Random random(seed);
  for (std::uint8_t& pixel : pixels) {
    double sum = 0;  // twelve uniform numbers make a good enough Gaussian
    for (int i = 0; i < 12; ++i) sum += random.uniform(-0.5, 0.5);
    pixel = grey_level(pixel + sigma * sum);
  }
}

}  // namespace sslam::testing
