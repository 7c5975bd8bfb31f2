// SPDX-License-Identifier: BSD-3-Clause
// What the bytes of an image file say before anybody decodes them: content counts, not the name's extension.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <span>

#include "cli/input/image_turn.hpp"

namespace sslam::cli {

using Bytes = std::span<const std::uint8_t>;

enum class ImageFormat : std::uint8_t { kOther, kJpeg, kPng, kWebp, kTiff, kBmp, kPnm, kHeif };

struct ImageHeader {
  ImageFormat format = ImageFormat::kOther;
  cv::Size size;  // of the stored pixels; empty: not known
  ImageTurn turn = kUpright;
  bool complete = true;  // false: the file has lost its end, which decoders fill with grey
  bool several = false;  // an animation, or pages: OpenCV gives the first image, or none
  std::size_t end = 0;   // where the image ends, or another begins in its midst; 0: not known, or not there
};

// `bytes` is the whole file. What stands behind the image's own end is not looked at.
[[nodiscard]] ImageHeader read_image_header(Bytes bytes);

}  // namespace sslam::cli
