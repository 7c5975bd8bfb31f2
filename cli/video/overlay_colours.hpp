// SPDX-License-Identifier: BSD-3-Clause
// The colours of features over photographs, light or dark: of the report's pictures and of the overlay video.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

namespace sslam::cli {

struct OverlayColour {
  std::uint8_t red = 0, green = 0, blue = 0;
  double opacity = 1;
};

inline constexpr OverlayColour kPale{255, 255, 255, 0.6};
// Segments by Manhattan axis: x, y, z, none.
inline constexpr std::array<OverlayColour, 4> kAxisOverlay{
    {{255, 79, 73}, {47, 214, 123}, {76, 157, 255}, kPale}};
// Features by whether they see the map: those that do, and the others.
inline constexpr OverlayColour kMappedPoint{255, 216, 77}, kOtherPoint = kPale;

// axis: 0, 1, 2, or negative for none.
[[nodiscard]] constexpr const OverlayColour& axis_overlay(int axis) noexcept {
  return kAxisOverlay[static_cast<std::size_t>(axis < 0 ? 3 : axis)];
}

[[nodiscard]] inline std::string css_colour(const OverlayColour& colour) {
  return "rgb(" + std::to_string(colour.red) + " " + std::to_string(colour.green) + " " +
         std::to_string(colour.blue) + " / " + std::to_string(std::lround(colour.opacity * 100)) + "%)";
}

}  // namespace sslam::cli
