// SPDX-License-Identifier: BSD-3-Clause
// What the image shows around a point feature: kept with it, so that views of one landmark can be compared
// once their images are gone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "sslam/core/types.hpp"
#include "sslam/image/image_view.hpp"

namespace sslam {

struct FeaturePatch {
  static constexpr int kRadius = 7;  // pixels of the feature's pyramid level
  static constexpr int kSide = 2 * kRadius + 1;

  std::array<std::uint8_t, kSide * kSide> grey;  // by rows, of the level as the lens shows it
  Vec2<float> centre;                            // the feature: column and row
  Mat2<float> spacing;                           // undistorted pixels for each pixel of the patch

  [[nodiscard]] ImageView<std::uint8_t> view() const noexcept { return {grey.data(), {kSide, kSide}}; }
};

// Around (x, y) of a level, which lies kRadius or more within it.
[[nodiscard]] inline FeaturePatch cut_patch(ImageView<std::uint8_t> level, float x, float y) noexcept {
  constexpr int kRadius = FeaturePatch::kRadius, kSide = FeaturePatch::kSide;
  const int left = static_cast<int>(std::lround(x)) - kRadius,
            top = static_cast<int>(std::lround(y)) - kRadius;
  FeaturePatch patch;
  for (int row = 0; row < kSide; ++row) {
    const std::uint8_t* from = level.row(top + row) + left;
    std::copy_n(from, kSide, patch.grey.data() + row * kSide);
  }
  patch.centre = {x - static_cast<float>(left), y - static_cast<float>(top)};
  patch.spacing.setIdentity();
  return patch;
}

}  // namespace sslam
