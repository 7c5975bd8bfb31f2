// SPDX-License-Identifier: BSD-3-Clause
// What is fixed to the image, whatever the camera sees.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace sslam::cli {

enum class ImageFixed : std::uint8_t {
  kNone,
  kText,  // burnt in: a name above, a running clock below
  kBar,   // a part of the vehicle or robot along the lower edge, with its markings
  kDots,  // spots such as the infrared projector of a depth camera throws, placed by the seed
};

// Onto an image that was taken `seconds` after the first.
void draw_image_fixed(ImageFixed kind, std::uint64_t seed, double seconds, cv::Mat& bgr);

}  // namespace sslam::cli
