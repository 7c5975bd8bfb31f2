// SPDX-License-Identifier: BSD-3-Clause
// ORB points: FAST corners of an image pyramid, spread by a grid, localised to a fraction of a pixel, with
// orientation and rotated BRIEF descriptor.
#pragma once

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "sslam/map/frame.hpp"
#include "sslam/opencv/brief.hpp"
#include "sslam/opencv/corner_grid.hpp"
#include "sslam/opencv/corner_refiner.hpp"
#include "sslam/opencv/image_pyramid.hpp"

namespace sslam {

struct OrbOptions {
  int points = 1200;        // at most, over all levels
  int levels = 8;           // of the pyramid
  double ratio = 1.2;       // size of a level over the size of the next
  double max_offset = 1.5;  // of the subpixel place from the corner's pixel, pixels of the level
  CornerGridOptions grid;
};

class OrbExtractor {
 public:
  OrbOptions options;

  // Replaces `points` with the corners of `grey` (8 bit, one channel), in distorted pixels of that image.
  // An image too small for a patch gives none.
  void extract(const cv::Mat& grey, std::vector<PointFeature<double>>& points) {
    points.clear();
    if (grey.empty() || grey.type() != CV_8UC1) return;
    constexpr int kMinSide = 2 * (RotatedBrief::kRadius + 1) + 8;
    pyramid_.build(grey, options.levels, options.ratio, kMinSide);
    CornerGridOptions grid = options.grid;
    grid.border = std::max(grid.border, RotatedBrief::kRadius + 1);
    // Finer levels first; what a level cannot use goes to the coarser ones.
    double weight = 0;
    for (std::size_t level = 0; level < pyramid_.size(); ++level) weight += 1 / pyramid_.scale(level);
    int left = options.points;
    for (std::size_t level = 0; level < pyramid_.size(); ++level) {
      const double share = 1 / pyramid_.scale(level);
      chosen_.clear();
      grid_.choose(pyramid_.image(level), static_cast<int>(std::lround(left * share / weight)), grid,
                   chosen_);
      left -= static_cast<int>(chosen_.size());
      weight -= share;
      if (!chosen_.empty()) describe(level, points);
    }
  }

 private:
  void describe(std::size_t level, std::vector<PointFeature<double>>& points) {
    const cv::Mat& image = pyramid_.image(level);
    cv::GaussianBlur(image, smooth_, {7, 7}, 2, 2, cv::BORDER_REFLECT_101);
    for (const cv::KeyPoint& corner : chosen_) {
      const int x = static_cast<int>(corner.pt.x), y = static_cast<int>(corner.pt.y);
      const float angle = brief_.orientation(image, x, y);
      PointFeature<double> point;
      point.pixel =
          pyramid_.to_full(Vec2<double>(x, y) + corner_offset(image, x, y, options.max_offset), level);
      point.sigma = pyramid_.scale(level);
      point.angle = angle;
      point.octave = static_cast<std::uint8_t>(level);
      point.descriptor = brief_.describe(smooth_, x, y, angle);
      points.push_back(point);
    }
  }

  ImagePyramid pyramid_;
  CornerGrid grid_;
  RotatedBrief brief_;
  std::vector<cv::KeyPoint> chosen_;
  cv::Mat smooth_;
};

}  // namespace sslam
