// SPDX-License-Identifier: BSD-3-Clause
// Where in one picture, the atlas, each of a model's surfaces is shown.
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "sslam/dense/dense_model.hpp"

namespace sslam::cli {

// A rectangle of the atlas that shows a rectangle of a plane.
struct Chart {
  std::size_t plane = 0, polygon = 0;
  cv::Rect place;       // in the atlas
  Vec2<double> origin;  // in the plane's coordinates: of the centre of its first texel
};

struct ChartLayout {
  std::vector<Chart> charts;
  double texel = 0;  // side, units of the map
  cv::Size size;     // of the atlas
};

// A chart for each polygon. `texel`: that is wanted; it is coarser where the atlas would grow too large.
[[nodiscard]] ChartLayout lay_out_charts(const dense::DenseModel& model, double texel);

}  // namespace sslam::cli
