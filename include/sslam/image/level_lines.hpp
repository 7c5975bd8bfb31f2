// SPDX-License-Identifier: BSD-3-Clause
// The level lines of an image: where the grey value changes, the direction along which it does not, and the
// steepest places first (Grompone von Gioi, Jakubowicz, Morel, Randall, LSD, IPOL 2012: gradient and
// pseudo-ordering).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sslam/core/types.hpp"
#include "sslam/image/image_view.hpp"

namespace sslam {

class LevelLines {
 public:
  // A place is the corner that four pixels share. Changes of less than `min_slope` grey levels a pixel have
  // no level line.
  void compute(ImageView<std::uint8_t> image, float min_slope) {
    stride_ = image.width();
    const auto stride = static_cast<std::size_t>(stride_);
    const std::size_t size = stride * static_cast<std::size_t>(image.height() + 1) + 1;
    direction_.resize(size);
    slope_.assign(size, 0);
    float steepest = 0;
    for (int y = 0; y + 1 < image.height(); ++y) {
      const std::uint8_t* upper = image.row(y);
      const std::uint8_t* lower = image.row(y + 1);
      const std::size_t row = stride * static_cast<std::size_t>(y + 1);
      for (int x = 0; x + 1 < image.width(); ++x) {
        const int falling = lower[x + 1] - upper[x], rising = upper[x + 1] - lower[x];
        const float dx = static_cast<float>(falling + rising) / 2,
                    dy = static_cast<float>(falling - rising) / 2;
        const float square = dx * dx + dy * dy;
        if (square < min_slope * min_slope) continue;
        const float slope = std::sqrt(square);
        const std::size_t place = row + static_cast<std::size_t>(x + 1);
        slope_[place] = slope;
        direction_[place] = Vec2<float>(-dy, dx) / slope;
        steepest = std::max(steepest, slope);
      }
    }
    sort(steepest);
  }

  // Where there is a level line, the steepest first.
  [[nodiscard]] const std::vector<int>& places() const noexcept { return places_; }

  // Grey levels a pixel; 0 where there is no level line.
  [[nodiscard]] float slope(int place) const noexcept { return slope_[static_cast<std::size_t>(place)]; }

  // Unit, brighter on its left hand (x right, y down); only where there is a level line.
  [[nodiscard]] const Vec2<float>& direction(int place) const noexcept {
    return direction_[static_cast<std::size_t>(place)];
  }

  [[nodiscard]] Vec2<double> pixel(int place) const noexcept {
    return {place % stride_ - 0.5, place / stride_ - 0.5};
  }

  // The eight places around one that has a level line. Some may be off the image, but then have none.
  [[nodiscard]] std::array<int, 8> around(int place) const noexcept {
    const int above = place - stride_, below = place + stride_;
    return {above - 1, above, above + 1, place - 1, place + 1, below - 1, below, below + 1};
  }

  // One more than the largest place.
  [[nodiscard]] std::size_t size() const noexcept { return slope_.size(); }

 private:
  // In bins of the slope, within each as in the image.
  void sort(float steepest) {
    std::array<int, kBins + 1> first{};
    const float bins = steepest > 0 ? (kBins - 1) / steepest : 0;
    const auto bin = [&](float slope) {
      return static_cast<std::size_t>(kBins - 1 - static_cast<int>(slope * bins));
    };
    for (const float slope : slope_)
      if (slope > 0) ++first[bin(slope) + 1];
    for (std::size_t b = 0; b < kBins; ++b) first[b + 1] += first[b];
    places_.resize(static_cast<std::size_t>(first[kBins]));
    for (std::size_t place = 0; place < slope_.size(); ++place)
      if (slope_[place] > 0)
        places_[static_cast<std::size_t>(first[bin(slope_[place])]++)] = static_cast<int>(place);
  }

  static constexpr int kBins = 1024;

  int stride_ = 1;  // one place without a level line lies left of each row, and a row of them above the first
  std::vector<float> slope_;
  std::vector<Vec2<float>> direction_;
  std::vector<int> places_;
};

}  // namespace sslam
