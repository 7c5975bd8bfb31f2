// SPDX-License-Identifier: BSD-3-Clause
// The look of a model's planes, from the keyframes that see them best, in one picture.
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "cli/dense/chart_layout.hpp"
#include "sslam/dense/dense_model.hpp"

namespace sslam::cli {

struct Atlas {
  cv::Mat_<cv::Vec3b> image;  // BGR
  double texel = 0;           // side, units of the map
  std::vector<Chart> charts;

  // Where in the image a place of the chart's plane is seen, pixels.
  [[nodiscard]] Vec2<double> pixel(const Chart& chart, const Vec2<double>& u) const {
    return (u - chart.origin) / texel + Vec2<double>(chart.place.x, chart.place.y);
  }
};

struct TextureInput {
  const dense::DenseModel& model;
  std::span<const dense::DenseView> views;
  double texel = 0;  // that is wanted; coarser where the atlas would grow too large
  std::function<cv::Mat(std::size_t)>
      image;  // of a view, BGR, undistorted, at `scale` of the view's grey image
  double scale = 1;
};

[[nodiscard]] Atlas make_atlas(const TextureInput& input);

}  // namespace sslam::cli
