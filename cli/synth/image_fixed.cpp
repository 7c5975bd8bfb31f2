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

// Adds a Gaussian spot, the same to all channels.
void draw_spot(const cv::Point2d& at, double sigma, double grey, cv::Mat& bgr) {
  const int reach = static_cast<int>(std::ceil(4.0 * sigma));
  const int column = static_cast<int>(std::lround(at.x)), row = static_cast<int>(std::lround(at.y));
  const cv::Rect around(column - reach, row - reach, 2 * reach + 1, 2 * reach + 1);
  const cv::Rect inside = around & cv::Rect(0, 0, bgr.cols, bgr.rows);
  for (int y = inside.y; y < inside.y + inside.height; ++y) {
    for (int x = inside.x; x < inside.x + inside.width; ++x) {
      const double far = std::hypot(x - at.x, y - at.y) / sigma, light = grey * std::exp(-0.5 * far * far);
      cv::Vec3b& pixel = bgr.at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<std::uint8_t>(pixel[c] + light);
    }
  }
}

// One in each cell of a grid, anywhere in it.
void draw_dots(std::uint64_t seed, cv::Mat& bgr) {
  constexpr int kColumns = 20, kRows = 15;
  const double scale = bgr.rows / 480.0;
  Random random(seed ^ 0xD1B54A32D192ED03ULL);
  for (int i = 0; i < kColumns * kRows; ++i) {
    const double across = random.uniform(0.0, 1.0), down = random.uniform(0.0, 1.0);
    const double sigma = std::max(0.6, scale * random.uniform(0.9, 1.3)), grey = random.uniform(60.0, 160.0);
    draw_spot(
        {(i % kColumns + across) * bgr.cols / kColumns - 0.5, (i / kColumns + down) * bgr.rows / kRows - 0.5},
        sigma, grey, bgr);
  }
}

}  // namespace

void draw_image_fixed(ImageFixed kind, std::uint64_t seed, double seconds, cv::Mat& bgr) {
  if (kind == ImageFixed::kText) draw_text(seconds, bgr);
  if (kind == ImageFixed::kBar) draw_bar(bgr);
  if (kind == ImageFixed::kDots) draw_dots(seed, bgr);
}

}  // namespace sslam::cli
