// SPDX-License-Identifier: BSD-3-Clause
// The page of an SVG plot: which two world axes it shows, to what scale, and the grid behind the curves.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

#include "sslam/core/types.hpp"

namespace sslam::io::svg {

inline constexpr double kWidth = 900;
inline constexpr double kHeight = 700;
inline constexpr double kLeft = 70;  // room for the labels of the axis
inline constexpr double kTop = 60;
inline constexpr double kRight = 30;
inline constexpr double kBottom = 55;

struct Range {
  double low = 0;
  double high = 0;
  [[nodiscard]] double size() const noexcept { return high - low; }
  [[nodiscard]] double middle() const noexcept { return (high + low) / 2; }
};

// World to page.
struct View {
  int across = 0;  // world axis that points right on the page
  int up = 1;      // world axis that points up on the page
  double scale = 1;
  Vec2<double> centre{0, 0};

  [[nodiscard]] Vec2<double> operator()(const Vec3<double>& p) const noexcept {
    return {(kLeft + kWidth - kRight) / 2 + scale * (p[across] - centre.x()),
            (kTop + kHeight - kBottom) / 2 - scale * (p[up] - centre.y())};
  }
};

[[nodiscard]] inline std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else {
      result += c;
    }
  }
  return result;
}

// 1, 2 or 5 times a power of ten, for about `wanted` steps over `extent`.
[[nodiscard]] inline double tick_step(double extent, double wanted) noexcept {
  const double raw = extent / wanted;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10 * power;
}

// Shows the two axes along which `leading` extends most, to the scale at which all of `leading` and `others`
// is seen.
[[nodiscard]] inline View fit(std::span<const Vec3<double>> leading, std::span<const Vec3<double>> others) {
  using Box = std::array<Range, 3>;
  const auto box_of = [](std::span<const Vec3<double>> positions, Box box, bool empty) {
    for (const Vec3<double>& p : positions) {
      for (int axis = 0; axis < 3; ++axis) {
        Range& range = box[static_cast<std::size_t>(axis)];
        range.low = empty ? p[axis] : std::min(range.low, p[axis]);
        range.high = empty ? p[axis] : std::max(range.high, p[axis]);
      }
      empty = false;
    }
    return box;
  };
  const Box box = box_of(leading, Box{}, true);
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(),
                   [&](std::size_t a, std::size_t b) { return box[a].size() > box[b].size(); });
  const Box all = box_of(others, box, leading.empty());
  const std::size_t across = std::min(axes[0], axes[1]);
  const std::size_t up = std::max(axes[0], axes[1]);
  constexpr double kMargin = 1.15;
  constexpr double kSmallest = 1e-6;
  View view;
  view.across = static_cast<int>(across);
  view.up = static_cast<int>(up);
  view.scale = std::min((kWidth - kLeft - kRight) / std::max(kMargin * all[across].size(), kSmallest),
                        (kHeight - kTop - kBottom) / std::max(kMargin * all[up].size(), kSmallest));
  view.centre = {all[across].middle(), all[up].middle()};
  return view;
}

template <class... Numbers>
[[nodiscard]] std::string format(const char* pattern, Numbers... numbers) {
  char text[320];
  std::snprintf(text, sizeof text, pattern, numbers...);
  return text;
}

inline void draw_grid(std::ostream& out, const View& view, std::string_view unit) {
  constexpr char kNames[] = "xyz";
  const Vec2<double> middle((kLeft + kWidth - kRight) / 2, (kTop + kHeight - kBottom) / 2);
  const Vec2<double> half((kWidth - kLeft - kRight) / 2 / view.scale,
                          (kHeight - kTop - kBottom) / 2 / view.scale);
  const double step = tick_step(2 * half.maxCoeff(), 9);
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step))));
  // Whole multiples of the step, so that zero prints as zero.
  const auto first = [step](double low) { return static_cast<long>(std::ceil(low / step)); };
  const auto last = [step](double high) { return static_cast<long>(std::floor(high / step)); };
  out << "<g stroke=\"#e4e4e4\" fill=\"#666\" font-size=\"12\">\n";
  for (long k = first(view.centre.x() - half.x()); k <= last(view.centre.x() + half.x()); ++k) {
    const double value = static_cast<double>(k) * step;
    const double x = middle.x() + view.scale * (value - view.centre.x());
    out << format("<path d=\"M%.1f %.1fV%.1f\"/>", x, kTop, kHeight - kBottom)
        << format("<text stroke=\"none\" x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%.*f</text>\n", x,
                  kHeight - kBottom + 17, decimals, value);
  }
  for (long k = first(view.centre.y() - half.y()); k <= last(view.centre.y() + half.y()); ++k) {
    const double value = static_cast<double>(k) * step;
    const double y = middle.y() - view.scale * (value - view.centre.y());
    out << format("<path d=\"M%.1f %.1fH%.1f\"/>", kLeft, y, kWidth - kRight)
        << format("<text stroke=\"none\" x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%.*f</text>\n", kLeft - 6,
                  y + 4, decimals, value);
  }
  out << "</g>\n"
      << format("<text x=\"%.0f\" y=\"%.0f\" text-anchor=\"middle\" font-size=\"13\">%c [", middle.x(),
                kHeight - 12, kNames[view.across])
      << escaped(unit) << "]</text>\n"
      << format(
             "<text transform=\"translate(18 %.0f) rotate(-90)\" text-anchor=\"middle\" font-size=\"13\">%c "
             "[",
             middle.y(), kNames[view.up])
      << escaped(unit) << "]</text>\n";
}

}  // namespace sslam::io::svg
