// SPDX-License-Identifier: BSD-3-Clause
// The size of an image, for people.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace sslam::cli {

[[nodiscard]] inline std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}
[[nodiscard]] inline std::string size_text(cv::Size size) {
  return size_text(size.width, size.height);
}

[[nodiscard]] inline std::string wrong_size(const std::string& image, cv::Size size, cv::Size camera) {
  return image + ": has " + size_text(size) + " pixels, and the camera " + size_text(camera);
}

}  // namespace sslam::cli
