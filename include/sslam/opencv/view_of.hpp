// SPDX-License-Identifier: BSD-3-Clause
// OpenCV's images as the image algorithms read them.
#pragma once

#include <cassert>
#include <cstddef>
#include <opencv2/core.hpp>

#include "sslam/image/image_view.hpp"

namespace sslam {

[[nodiscard]] inline ImageSize size_of(const cv::Mat& image) noexcept {
  return {image.cols, image.rows};
}

// `image` has one channel of type Pixel, and outlives the view.
template <class Pixel>
[[nodiscard]] ImageView<Pixel> view_of(const cv::Mat& image) noexcept {
  assert(image.empty() || image.type() == cv::traits::Type<Pixel>::value);
  return {image.ptr<Pixel>(), size_of(image), static_cast<std::ptrdiff_t>(image.step1())};
}

}  // namespace sslam
