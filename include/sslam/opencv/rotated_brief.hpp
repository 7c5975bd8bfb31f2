// SPDX-License-Identifier: BSD-3-Clause
// Rotated BRIEF (Rublee, Rabaud, Konolige, Bradski, "ORB", ICCV 2011): the orientation of a patch by its
// intensity centroid, and 256 brightness tests turned into that orientation.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <opencv2/core.hpp>

#include "sslam/core/descriptor.hpp"
#include "sslam/core/random.hpp"

namespace sslam {

class RotatedBrief {
 public:
  static constexpr int kRadius = 15;  // pixels around a corner that orientation and tests look at

  explicit RotatedBrief(std::uint64_t seed = 1) {
    draw_tests(seed);
    for (int v = 0; v <= kRadius; ++v)
      half_width_[static_cast<std::size_t>(v)] =
          static_cast<int>(std::sqrt(double(kRadius * kRadius - v * v)) + 0.5);
  }

  // Direction from the corner to the centroid of intensity in the disc of kRadius, radians. The pixel must
  // lie kRadius or more from the border of the 8 bit image.
  [[nodiscard]] float orientation(const cv::Mat& image, int x, int y) const noexcept {
    const auto stride = static_cast<std::ptrdiff_t>(image.step1());
    const std::uint8_t* centre = image.ptr<std::uint8_t>(y) + x;
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

  // `smooth` is the blurred image (8 bit); same border as orientation().
  [[nodiscard]] Descriptor describe(const cv::Mat& smooth, int x, int y, float angle) const noexcept {
    const auto stride = static_cast<std::ptrdiff_t>(smooth.step1());
    const std::uint8_t* centre = smooth.ptr<std::uint8_t>(y) + x;
    const auto& tests = turned_[turn_of(angle)];
    Descriptor descriptor;
    std::size_t i = 0;
    for (auto& word : descriptor.words) {
      for (int bit = 0; bit < 64; ++bit, ++i) {
        const Test& t = tests[i];
        const bool less = centre[t.ay * stride + t.ax] < centre[t.by * stride + t.bx];
        word |= static_cast<std::uint64_t>(less) << bit;
      }
    }
    return descriptor;
  }

 private:
  static constexpr int kTurns = 64;  // orientations for which the tests are prepared
  struct Test {
    std::int8_t ax, ay, bx, by;
  };

  [[nodiscard]] static std::size_t turn_of(float angle) noexcept {
    const int turn = static_cast<int>(std::lround(angle * (kTurns / (2 * std::numbers::pi_v<float>))));
    return static_cast<std::size_t>(turn & (kTurns - 1));
  }

  // Pairs of points, each drawn from an isotropic Gaussian over the disc (BRIEF's second scheme).
  void draw_tests(std::uint64_t seed) {
    Random random(seed);
    const auto point = [&] {
      for (;;) {
        const double r = kSpread * std::sqrt(-2 * std::log(1 - random.uniform(0.0, 1.0)));
        const double a = random.uniform(0.0, 2 * std::numbers::pi);
        if (r < kRadius - 0.5) return std::array<double, 2>{r * std::cos(a), r * std::sin(a)};
      }
    };
    for (std::size_t i = 0; i < 256; ++i) {
      const auto a = point();
      auto b = point();
      while (std::hypot(a[0] - b[0], a[1] - b[1]) < 2) b = point();
      for (int turn = 0; turn < kTurns; ++turn) {
        const double c = std::cos(2 * std::numbers::pi * turn / kTurns);
        const double s = std::sin(2 * std::numbers::pi * turn / kTurns);
        const auto round = [](double v) { return static_cast<std::int8_t>(std::lround(v)); };
        turned_[static_cast<std::size_t>(turn)][i] = {round(c * a[0] - s * a[1]), round(s * a[0] + c * a[1]),
                                                      round(c * b[0] - s * b[1]), round(s * b[0] + c * b[1])};
      }
    }
  }

  static constexpr double kSpread = 31.0 / 5;  // standard deviation of a test point, pixels
  std::array<std::array<Test, 256>, kTurns> turned_{};
  std::array<int, kRadius + 1> half_width_{};
};

}  // namespace sslam
