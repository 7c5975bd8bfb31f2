// SPDX-License-Identifier: BSD-3-Clause
// An image pyramid whose buffers live on from frame to frame, with exact maps from each level to the full
// image.
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "sslam/core/types.hpp"

namespace sslam {

class ImagePyramid {
 public:
  // Fills at most `levels` levels, each `ratio` times smaller than the one before; stops where a level would
  // be smaller than `min_side` pixels. Level 0 shares the memory of `grey` (8 bit, one channel).
  void build(const cv::Mat& grey, int levels, double ratio, int min_side) {
    levels_.resize(static_cast<std::size_t>(std::max(levels, 1)));
    count_ = 0;
    double scale = 1;
    for (auto& level : levels_) {
      const cv::Size size(static_cast<int>(std::lround(grey.cols / scale)),
                          static_cast<int>(std::lround(grey.rows / scale)));
      if (std::min(size.width, size.height) < min_side) break;
      if (count_ == 0)
        level.image = grey;
      else
        cv::resize(levels_[count_ - 1].image, level.image, size, 0, 0, cv::INTER_LINEAR);
      level.scale_x = static_cast<double>(grey.cols) / size.width;
      level.scale_y = static_cast<double>(grey.rows) / size.height;
      ++count_;
      scale *= ratio;
    }
  }

  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] const cv::Mat& image(std::size_t level) const noexcept { return levels_[level].image; }
  [[nodiscard]] double scale(std::size_t level) const noexcept { return levels_[level].scale_x; }

  // Pixels of the full image for each of a level, along x and y.
  [[nodiscard]] Vec2<double> spacing(std::size_t level) const noexcept {
    return {levels_[level].scale_x, levels_[level].scale_y};
  }

  // Pixels of a level to pixels of the full image. Both count from the centre of their top left pixel, hence
  // the half pixel.
  [[nodiscard]] Vec2<double> to_full(const Vec2<double>& pixel, std::size_t level) const noexcept {
    return {(pixel.x() + 0.5) * levels_[level].scale_x - 0.5,
            (pixel.y() + 0.5) * levels_[level].scale_y - 0.5};
  }

 private:
  struct Level {
    cv::Mat image;
    double scale_x = 1, scale_y = 1;
  };
  std::vector<Level> levels_;
  std::size_t count_ = 0;
};

}  // namespace sslam
