// SPDX-License-Identifier: BSD-3-Clause
// Rotated BRIEF (Rublee, Rabaud, Konolige, Bradski, "ORB", ICCV 2011): the orientation of a patch by its
// intensity centroid, and 256 brightness tests turned into that orientation.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "sslam/core/descriptor.hpp"
#include "sslam/image/brief_tests.hpp"
#include "sslam/image/image_view.hpp"

namespace sslam {

class RotatedBrief {
 public:
  static constexpr int kRadius = 15;  // pixels around a corner that orientation and tests look at

  RotatedBrief() {
    turn_tests();
    for (int v = 0; v <= kRadius; ++v)
      half_width_[static_cast<std::size_t>(v)] =
          static_cast<int>(std::sqrt(double(kRadius * kRadius - v * v)) + 0.5);
  }

  // Direction from the corner to the centroid of intensity in the disc of kRadius, radians. The pixel must
  // lie kRadius or more from the border of the grey image.
  [[nodiscard]] float orientation(ImageView<std::uint8_t> image, int x, int y) const noexcept {
    const std::ptrdiff_t stride = image.stride();
    const std::uint8_t* centre = image.row(y) + x;
    int mx = 0, my = 0;
    for (int u = -kRadius; u <= kRadius; ++u) mx += u * centre[u];
    for (int v = 1; v <= kRadius; ++v) {
      const int width = half_width_[static_cast<std::size_t>(v)];
      const std::uint8_t* below = centre + v * stride;
      const std::uint8_t* above = centre - v * stride;
      int row = 0;
      for (int u = -width; u <= width; ++u) {
        row += below[u] - above[u];
        mx += u * (below[u] + above[u]);
      }
      my += v * row;
    }
    return std::atan2(static_cast<float>(my), static_cast<float>(mx));
  }

  // `smooth` is the blurred image; same border as orientation().
  [[nodiscard]] Descriptor describe(ImageView<std::uint8_t> smooth, int x, int y,
                                    float angle) const noexcept {
    const std::ptrdiff_t stride = smooth.stride();
    const std::uint8_t* centre = smooth.row(y) + x;
    const auto& tests = turned_[turn_of(angle)];
    Descriptor descriptor;
    std::size_t i = 0;
    for (auto& word : descriptor.words) {
      for (int bit = 0; bit < 64; ++bit, ++i) {
        const BriefTest& t = tests[i];
        const bool less = centre[t.ay * stride + t.ax] < centre[t.by * stride + t.bx];
        word |= static_cast<std::uint64_t>(less) << bit;
      }
    }
    return descriptor;
  }

 private:
  static constexpr std::size_t kTurns = 64;  // orientations for which the tests are prepared

  [[nodiscard]] static std::size_t turn_of(float angle) noexcept {
    const int turn = static_cast<int>(std::lround(angle * (kTurns / (2 * std::numbers::pi_v<float>))));
    return static_cast<std::size_t>(turn) & (kTurns - 1);
  }

  void turn_tests() noexcept {
    for (std::size_t turn = 0; turn < kTurns; ++turn) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(turn) / kTurns;
      const double c = std::cos(angle), s = std::sin(angle);
      const auto round = [](double v) { return static_cast<std::int8_t>(std::lround(v)); };
      for (std::size_t i = 0; i < kBriefTests.size(); ++i) {
        const BriefTest& t = kBriefTests[i];
        turned_[turn][i] = {round(c * t.ax - s * t.ay), round(s * t.ax + c * t.ay),
                            round(c * t.bx - s * t.by), round(s * t.bx + c * t.by)};
      }
    }
  }

  std::array<std::array<BriefTest, 256>, kTurns> turned_{};
  std::array<int, kRadius + 1> half_width_{};
};

}  // namespace sslam
