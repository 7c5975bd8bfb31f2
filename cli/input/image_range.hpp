// SPDX-License-Identifier: BSD-3-Clause
// Images of 16 bit hold 10 to 14 bits of a sensor, or the narrow band of a thermal camera: which values of
// them are black and white.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace sslam::cli {

class ImageRange {
 public:
  // Counts the values of an image of 16 bit.
  void add(const cv::Mat& image);
  [[nodiscard]] bool empty() const noexcept { return values_ == 0; }
  // Call when all are counted. From now on the range is held: a range for each image would flicker.
  void settle();

  // 8 bit, of as many channels.
  [[nodiscard]] cv::Mat apply(const cv::Mat& image) const;
  // For people.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<std::size_t> counts_ = std::vector<std::size_t>(65536);
  std::size_t values_ = 0;
  int black_ = 0, white_ = 65535;
};

}  // namespace sslam::cli
