// SPDX-License-Identifier: BSD-3-Clause
#include "cli/dense/chart_layout.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sslam::cli {
namespace {

constexpr int kMargin = 2;           // texels around a chart
constexpr int kWidest = 4096;        // of the atlas, pixels
constexpr double kMostTexels = 8e6;  // of all charts

// Rows of charts, the highest first. False where they are wider or higher than the atlas may be.
bool pack(std::vector<Chart>& charts, cv::Size& size) {
  std::vector<std::size_t> order(charts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return charts[a].place.height > charts[b].place.height;
  });
  double area = 0;
  int widest = 1;
  for (const Chart& chart : charts) {
    area += 1.1 * chart.place.area();
    widest = std::max(widest, chart.place.width);
  }
  const int width = std::max(widest, std::min(kWidest, static_cast<int>(std::ceil(std::sqrt(area)))));
  int x = 0, y = 0, row = 0;
  for (const std::size_t i : order) {
    cv::Rect& place = charts[i].place;
    if (x + place.width > width) {
      x = 0;
      y += row;
      row = 0;
    }
    place.x = x;
    place.y = y;
    x += place.width;
    row = std::max(row, place.height);
  }
  size = {width, y + row};
  return width <= kWidest && size.height <= kWidest;
}

std::vector<Chart> cut_charts(const dense::DenseModel& model, double texel) {
  std::vector<Chart> charts;
  for (std::size_t p = 0; p < model.planes.size(); ++p)
    for (std::size_t k = 0; k < model.planes[p].polygons.size(); ++k) {
      Vec2<double> low = model.planes[p].polygons[k].outer.front(), high = low;
      for (const Vec2<double>& u : model.planes[p].polygons[k].outer) {
        low = low.cwiseMin(u);
        high = high.cwiseMax(u);
      }
      const Vec2<double> size = (high - low) / texel;
      Chart chart{p, k, {}, low - Vec2<double>::Constant(kMargin * texel)};
      chart.place.width = static_cast<int>(std::ceil(std::min(size.x(), 1e6))) + 1 + 2 * kMargin;
      chart.place.height = static_cast<int>(std::ceil(std::min(size.y(), 1e6))) + 1 + 2 * kMargin;
      charts.push_back(chart);
    }
  return charts;
}

}  // namespace

ChartLayout lay_out_charts(const dense::DenseModel& model, double texel) {
  ChartLayout layout;
  for (layout.texel = texel;; layout.texel *= 1.2) {
    layout.charts = cut_charts(model, layout.texel);
    double texels = 0;
    for (const Chart& chart : layout.charts)
      texels += static_cast<double>(chart.place.width) * chart.place.height;
    if (texels < kMostTexels && pack(layout.charts, layout.size)) return layout;
  }
}

}  // namespace sslam::cli
