// SPDX-License-Identifier: BSD-3-Clause
// Parts of the image that are no world: the robot itself, a display, burnt-in text.
#pragma once

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "sslam/core/types.hpp"

namespace sslam {

class ImageMask {
 public:
  // `mask`: 8 bit, 0 where nothing is to be found; empty: everywhere all. False: it is not of this kind or
  // size.
  [[nodiscard]] bool set(const cv::Mat& mask, cv::Size size) {
    active_ = !mask.empty();
    if (!active_) return true;
    if (mask.type() != CV_8UC1 || mask.size() != size) return active_ = false;
    cv::distanceTransform(mask, distance_, cv::DIST_L2, cv::DIST_MASK_5);
    cv::compare(mask, 0, covered_, cv::CMP_EQ);
    return true;
  }

  [[nodiscard]] bool active() const noexcept { return active_; }

  // Takes away what is to be seen there: it must not use up the features that a frame may have.
  void flatten(cv::Mat& grey) const {
    if (active_) grey.setTo(cv::mean(grey), covered_);
  }
  void erase_depth(cv::Mat& depth) const { depth.setTo(0, covered_); }

  // Pixels from here to the nearest that is left out: 0 inside; beyond the image nothing is left out.
  [[nodiscard]] double distance(const Vec2<double>& pixel) const {
    constexpr double kFar = 1e6;
    if (!(pixel.array().abs() < kFar).all()) return kFar;
    const auto x = static_cast<int>(std::lround(pixel.x())), y = static_cast<int>(std::lround(pixel.y()));
    if (x < 0 || y < 0 || x >= distance_.cols || y >= distance_.rows) return kFar;
    return static_cast<double>(distance_.at<float>(y, x));
  }

 private:
  bool active_ = false;
  cv::Mat distance_;  // 32 bit float
  cv::Mat covered_;   // 255 where left out
};

}  // namespace sslam
