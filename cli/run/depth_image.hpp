// SPDX-License-Identifier: BSD-3-Clause
// A depth image, asked where a landmark of the map is seen.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "sslam/core/median.hpp"
#include "sslam/geometry/camera.hpp"

namespace sslam::cli {

// Of what was measured; 0 for other types, and where nothing was.
[[nodiscard]] inline double median_of_floats(const cv::Mat& depth) {
  if (depth.type() != CV_32FC1) return 0;
  std::vector<double> values;
  for (int v = 0; v < depth.rows; v += 4)
    for (int u = 0; u < depth.cols; u += 4)
      if (const float value = depth.at<float>(v, u); std::isfinite(value) && value > 0)
        values.push_back(value);
  return values.empty() ? 0 : median<double>(values);
}

// Depth at an undistorted pixel of the images as they are worked on.
class DepthImage {
 public:
  DepthImage(cv::Mat depth, double factor, const Camera<double>& working)
      : depth_(std::move(depth)), factor_(depth_.depth() == CV_16U ? factor : 1), camera_(working) {}

  // Neither depth nor colour is cut to the other's shape here.
  [[nodiscard]] bool fits() const {
    const double ratio = static_cast<double>(depth_.cols) * camera_.height / (depth_.rows * camera_.width);
    return depth_.channels() == 1 && (depth_.depth() == CV_16U || depth_.depth() == CV_32F) &&
           std::abs(ratio - 1) < 0.02;
  }

  // Metres along the optical axis; 0 where it was not measured, or where the surface ends nearby.
  [[nodiscard]] double operator()(const Vec2<double>& undistorted) const {
    constexpr double kStep = 1.05;  // within one surface, even a slanted one
    const Vec2<double> pixel = camera_.distort_pixel(undistorted);
    const int u = nearest(pixel.x(), camera_.width, depth_.cols);
    const int v = nearest(pixel.y(), camera_.height, depth_.rows);
    if (u < 1 || v < 1 || u >= depth_.cols - 1 || v >= depth_.rows - 1) return 0;
    double low = at(u, v), high = low;
    for (int dv = -1; dv <= 1; ++dv)
      for (int du = -1; du <= 1; ++du) {
        low = std::min(low, at(u + du, v + dv));
        high = std::max(high, at(u + du, v + dv));
      }
    return low > 0 && high <= kStep * low ? at(u, v) : 0;
  }

 private:
  static int nearest(double at, int from, int to) {
    const double there = (at + 0.5) * to / from - 0.5;
    return there > -1 && there < to ? static_cast<int>(std::lround(there)) : -1;
  }
  [[nodiscard]] double at(int u, int v) const {
    const double raw = depth_.depth() == CV_16U ? static_cast<double>(depth_.at<std::uint16_t>(v, u))
                                                : static_cast<double>(depth_.at<float>(v, u));
    return std::isfinite(raw) && raw > 0 ? raw / factor_ : 0;
  }

  cv::Mat depth_;
  double factor_;
  const Camera<double>& camera_;
};

}  // namespace sslam::cli
