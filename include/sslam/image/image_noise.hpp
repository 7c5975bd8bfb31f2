// SPDX-License-Identifier: BSD-3-Clause
// How noisy an image is.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "sslam/image/image_view.hpp"

namespace sslam {

// Standard deviation of the noise of a grey image, grey levels: the median absolute response of a mask
// that is blind to constant and linear brightness (Immerkaer, 1996), over a ninth of the pixels.
[[nodiscard]] inline double image_noise(ImageView<std::uint8_t> image) noexcept {
  constexpr int kStep = 3;
  std::array<int, 256> histogram{};
  int total = 0;
  for (int y = 1; y + 1 < image.height(); y += kStep) {
    const std::uint8_t* a = image.row(y - 1);
    const std::uint8_t* b = image.row(y);
    const std::uint8_t* c = image.row(y + 1);
    for (int x = 1; x + 1 < image.width(); x += kStep, ++total) {
      const int corners = a[x - 1] + a[x + 1] + c[x - 1] + c[x + 1],
                sides = a[x] + c[x] + b[x - 1] + b[x + 1];
      ++histogram[static_cast<std::size_t>(std::min(std::abs(corners - 2 * sides + 4 * b[x]), 255))];
    }
  }
  if (total == 0) return 0;
  int below = 0;
  std::size_t bin = 0;
  while (2 * (below + histogram[bin]) < total) below += histogram[bin++];
  const double median = static_cast<double>(bin) - 0.5 + (0.5 * total - below) / std::max(histogram[bin], 1);
  return std::max(0.0, median) * 1.4826 / 6;  // the mask multiplies sigma by 6
}

}  // namespace sslam
