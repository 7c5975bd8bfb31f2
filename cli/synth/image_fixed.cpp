// SPDX-License-Identifier: BSD-3-Clause
#include "cli/synth/image_fixed.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "sslam/core/random.hpp"

namespace sslam::cli {
namespace {

void draw_text(double seconds, cv::Mat& bgr) {
  const double scale = bgr.rows / 480.0;
  const int thick = std::max(1, static_cast<int>(std::lround(1.5 * scale)));
  const int margin = std::max(2, bgr.rows / 40);
  const int whole = static_cast<int>(seconds);
  const auto put = [&](const std::string& text, int bottom) {
    for (const bool outline : {true, false}) {
      cv::putText(bgr, text, {margin, bottom}, cv::FONT_HERSHEY_SIMPLEX, 0.8 * scale,
                  outline ? cv::Scalar(0, 0, 0) : cv::Scalar(255, 255, 255), outline ? 3 * thick : thick,
                  cv::LINE_AA);
    }
  };
  put("CAM 01  FRONT", margin + static_cast<int>(20 * scale));
  put(cv::format("2024-05-17 %02d:%02d:%02d", 10 + whole / 3600 % 14, whole / 60 % 60, whole % 60),
      bgr.rows - margin);
}

void draw_bar(cv::Mat& bgr) {
  const int height = std::max(4, bgr.rows / 6), top = bgr.rows - height;
  cv::rectangle(bgr, {0, top, bgr.cols, height}, cv::Scalar(38, 36, 34), cv::FILLED);
  Random random(7);
  constexpr int kMarks = 24;
  for (int i = 0; i < kMarks; ++i) {
    const int left = bgr.cols * i / kMarks, width = std::max(1, bgr.cols / kMarks * 2 / 3);
    const int depth = std::max(1, static_cast<int>(height * random.uniform(0.2, 0.5)));
    const int down = top + static_cast<int>(height * random.uniform(0.1, 0.45));
    const int grey = 60 + static_cast<int>(random.below(140));
    cv::rectangle(bgr, {left, down, width, depth}, cv::Scalar(grey, grey, grey), cv::FILLED);
  }
}

}  // namespace

void draw_image_fixed(ImageFixed kind, double seconds, cv::Mat& bgr) {
  if (kind == ImageFixed::kText) draw_text(seconds, bgr);
  if (kind == ImageFixed::kBar) draw_bar(bgr);
}

}  // namespace sslam::cli
