// SPDX-License-Identifier: BSD-3-Clause
// A view of the caller's image, for callers without OpenCV: where its pixels are, and in what order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "sslam/core/error.hpp"

namespace sslam {

enum class PixelFormat : std::uint8_t { kGrey8, kBgr8, kRgb8, kBgra8, kRgba8 };

// Rows from top to bottom, pixels from left to right, 8 bit per channel. The caller owns the pixels; they are
// only read, and only during the call that gets the view.
struct ImageRef {
  const std::uint8_t* data = nullptr;
  int width = 0, height = 0;
  std::size_t stride = 0;  // bytes from one row to the next; 0: rows follow each other without a gap
  PixelFormat format = PixelFormat::kGrey8;
};

[[nodiscard]] constexpr int channels(PixelFormat format) noexcept {
  switch (format) {
    case PixelFormat::kGrey8:
      return 1;
    case PixelFormat::kBgr8:
    case PixelFormat::kRgb8:
      return 3;
    case PixelFormat::kBgra8:
    case PixelFormat::kRgba8:
      return 4;
  }
  return 0;
}

// The image as OpenCV's grey, BGR or BGRA: the caller's pixels, or a copy if red and blue must be swapped.
// Throws Error if no image can be as the view describes it.
[[nodiscard]] inline cv::Mat to_mat(const ImageRef& image) {
  if (image.data == nullptr || image.width <= 0 || image.height <= 0) return {};
  const auto row = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(channels(image.format));
  if (image.stride != 0 && image.stride < row)
    throw Error("image: a stride of " + std::to_string(image.stride) + " bytes is shorter than a row of " +
                std::to_string(row));
  // OpenCV takes no pointer to const; nothing writes through this one.
  auto* const pixels = const_cast<std::uint8_t*>(image.data);
  const cv::Mat seen(image.height, image.width, CV_8UC(channels(image.format)), pixels,
                     image.stride != 0 ? image.stride : row);
  cv::Mat turned;
  if (image.format == PixelFormat::kRgb8) cv::cvtColor(seen, turned, cv::COLOR_RGB2BGR);
  if (image.format == PixelFormat::kRgba8) cv::cvtColor(seen, turned, cv::COLOR_RGBA2BGRA);
  return turned.empty() ? seen : turned;
}

}  // namespace sslam
