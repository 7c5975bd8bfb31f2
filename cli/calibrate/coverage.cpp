// SPDX-License-Identifier: BSD-3-Clause
#include "cli/calibrate/coverage.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace sslam::cli {
namespace {

constexpr int kColumns = 10, kRows = 8;

cv::Mat_<int> count_corners(const Calibration& calibration) {
  cv::Mat_<int> counts(kRows, kColumns, 0);
  for (const BoardView& view : calibration.views) {
    for (const cv::Point2f& corner : view.image) {
      const int column = static_cast<int>(corner.x) * kColumns / calibration.camera.width;
      const int row = static_cast<int>(corner.y) * kRows / calibration.camera.height;
      ++counts(std::clamp(row, 0, kRows - 1), std::clamp(column, 0, kColumns - 1));
    }
  }
  return counts;
}

}  // namespace

double coverage_share(const Calibration& calibration) {
  return static_cast<double>(cv::countNonZero(count_corners(calibration))) / (kColumns * kRows);
}

cv::Mat coverage_picture(const Calibration& calibration) {
  const cv::Size size(calibration.camera.width, calibration.camera.height);
  const cv::Mat_<int> counts = count_corners(calibration);
  cv::Mat picture(size, CV_8UC3, cv::Scalar::all(255));
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const cv::Point low(column * size.width / kColumns, row * size.height / kRows);
      const cv::Point high((column + 1) * size.width / kColumns, (row + 1) * size.height / kRows);
      const bool empty = counts(row, column) == 0;
      cv::rectangle(picture, low, high, empty ? cv::Scalar(205, 205, 250) : cv::Scalar(240, 250, 240),
                    cv::FILLED);
      cv::rectangle(picture, low, high, cv::Scalar::all(215));
    }
  }
  const int radius = std::max(2, size.width / 320);
  for (std::size_t v = 0; v < calibration.views.size(); ++v) {
    const double share = std::min(1.0, calibration.view_errors[v]);  // of a pixel
    const cv::Scalar colour(40, 150 - 40 * share, 40 + 190 * share);
    for (const cv::Point2f& corner : calibration.views[v].image)
      cv::circle(picture, corner, radius, colour, cv::FILLED, cv::LINE_AA);
  }
  for (const BoardView& view : calibration.left_out)
    for (const cv::Point2f& corner : view.image)
      cv::drawMarker(picture, corner, cv::Scalar::all(140), cv::MARKER_TILTED_CROSS, 3 * radius);
  return picture;
}

}  // namespace sslam::cli
