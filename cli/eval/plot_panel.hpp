// SPDX-License-Identifier: BSD-3-Clause
// Axes with curves in a part of a figure.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "cli/eval/figure.hpp"
#include "sslam/io/plots/plot_view.hpp"

namespace sslam::cli {

inline constexpr FigureColour kFigureInk{30, 34, 42};  // of words

struct PlotCurve {
  std::vector<double> x, y;
  FigureColour colour{};
  double width = 1.2;
  double max_gap = 0;   // in x; a longer one breaks it; 0: none does
  double max_step = 0;  // in y, the same
};

// What no value has extended yet.
inline constexpr io::svg::Range kNoRange{std::numeric_limits<double>::infinity(),
                                         -std::numeric_limits<double>::infinity()};

void extend(io::svg::Range& range, const std::vector<double>& values);
// With a share of its size more on either side. Something of a size, whatever was seen.
[[nodiscard]] io::svg::Range widened(io::svg::Range range, double share);

// Of what the axes frame, in the figure's units; ticks and title stand around it.
struct PanelPlace {
  double left = 0, top = 0, width = 0, height = 0;
};

void draw_panel(Figure& figure, const PanelPlace& place, const std::string& title,
                const std::vector<PlotCurve>& curves, const io::svg::Range& x, const io::svg::Range& y);

}  // namespace sslam::cli
