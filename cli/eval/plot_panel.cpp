// SPDX-License-Identifier: BSD-3-Clause
#include "cli/eval/plot_panel.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sslam::cli {
namespace {

using io::svg::Range;

constexpr FigureColour kQuiet{98, 106, 118}, kGrid{226, 229, 234};
constexpr double kTextSize = 12;

// Axes with curves in a part of the figure.
class Panel {
 public:
  Panel(Figure& figure, const PanelPlace& place, const Range& x, const Range& y)
      : figure_(figure), place_(place), x_(x), y_(y) {}

  void draw(const std::string& title, const std::vector<PlotCurve>& curves) {
    text({place_.left, place_.top - 7}, title, FigureAnchor::kStart, kFigureInk);
    draw_ticks();
    for (const PlotCurve& curve : curves) draw_curve(curve);
  }

 private:
  [[nodiscard]] Vec2<double> at(double x, double y) const {
    return {place_.left + place_.width * (x - x_.low) / x_.size(),
            place_.top + place_.height * (1 - (y - y_.low) / y_.size())};
  }

  void text(const Vec2<double>& place, std::string words, FigureAnchor anchor, const FigureColour& colour) {
    figure_.texts.push_back({place, std::move(words), kTextSize, anchor, colour});
  }

  // Whole multiples of the step, so that zero prints as zero.
  template <class Draw>
  static void for_ticks(const Range& range, double wanted, Draw draw) {
    const double step = io::svg::tick_step(range.size(), wanted);
    const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9);
    for (double k = std::ceil(range.low / step); k * step <= range.high; ++k)
      draw(k * step, io::svg::format("%.*f", decimals, k * step + 0.0));
  }

  void draw_ticks() {
    for_ticks(x_, place_.width / 80, [&](double value, const std::string& number) {
      figure_.lines.push_back({{at(value, y_.low), at(value, y_.high)}, kGrid, 1});
      text(at(value, y_.low) + Vec2<double>(0, 15), number, FigureAnchor::kMiddle, kQuiet);
    });
    for_ticks(y_, place_.height / 25, [&](double value, const std::string& number) {
      figure_.lines.push_back({{at(x_.low, value), at(x_.high, value)}, kGrid, 1});
      text(at(x_.low, value) + Vec2<double>(-6, 4), number, FigureAnchor::kEnd, kQuiet);
    });
  }

  void draw_curve(const PlotCurve& curve) {
    FigureLine line{{}, curve.colour, curve.width};
    const auto end = [&] {
      if (line.points.size() > 1) figure_.lines.push_back(line);
      line.points.clear();
    };
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      const bool pause = i > 0 && curve.max_gap > 0 && curve.x[i] - curve.x[i - 1] > curve.max_gap;
      const bool jump = i > 0 && curve.max_step > 0 && std::abs(curve.y[i] - curve.y[i - 1]) > curve.max_step;
      if (pause || jump) end();
      line.points.push_back(at(curve.x[i], curve.y[i]));
    }
    end();
  }

  Figure& figure_;
  PanelPlace place_;
  Range x_, y_;
};

}  // namespace

void extend(io::svg::Range& range, const std::vector<double>& values) {
  for (const double value : values) {
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  }
}

io::svg::Range widened(io::svg::Range range, double share) {
  if (!(range.low <= range.high)) return {0, 1};
  const double more = std::max({share * range.size(), 1e-9 * std::abs(range.high), 1e-12});
  return {range.low - more, range.high + more};
}

void draw_panel(Figure& figure, const PanelPlace& place, const std::string& title,
                const std::vector<PlotCurve>& curves, const io::svg::Range& x, const io::svg::Range& y) {
  Panel(figure, place, x, y).draw(title, curves);
}

}  // namespace sslam::cli
