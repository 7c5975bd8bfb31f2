// SPDX-License-Identifier: BSD-3-Clause
// What the bytes of an image file say before anybody decodes them: content counts, not the name's extension.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <span>

namespace sslam::cli {

using Bytes = std::span<const std::uint8_t>;

enum class ImageFormat : std::uint8_t { kOther, kJpeg, kPng, kWebp, kTiff, kBmp, kPnm, kHeif };

// How the stored pixels have to be turned for an upright picture, in the numbers of EXIF.
using ImageTurn = int;
inline constexpr ImageTurn kUpright = 1;

struct ImageHeader {
  ImageFormat format = ImageFormat::kOther;
  cv::Size size;  // of the stored pixels; empty: not known
  ImageTurn turn = kUpright;
  bool complete = true;  // false: the file has lost its end, which decoders fill with grey
  std::size_t end = 0;   // where the image ends, or another begins in its midst; 0: not known, or not there
};

// `bytes` is the whole file. What stands behind the image's own end is not looked at.
[[nodiscard]] ImageHeader read_image_header(Bytes bytes);

// Whether width and height change places.
[[nodiscard]] constexpr bool swaps_sides(ImageTurn turn) noexcept {
  return turn >= 5;
}

[[nodiscard]] cv::Size turned_size(cv::Size stored, ImageTurn turn);
[[nodiscard]] cv::Mat turned_image(const cv::Mat& stored, ImageTurn turn);
// "by 90 degrees", for people.
[[nodiscard]] const char* turn_text(ImageTurn turn);

}  // namespace sslam::cli
