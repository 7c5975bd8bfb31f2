// SPDX-License-Identifier: BSD-3-Clause
// Turns of stored pixels, as the orientation tags of photos and videos ask for them.
#pragma once

#include <opencv2/core.hpp>

namespace sslam::cli {

// How the stored pixels have to be turned for an upright picture, in the numbers of EXIF.
using ImageTurn = int;
inline constexpr ImageTurn kUpright = 1;

// Whether width and height change places.
[[nodiscard]] constexpr bool swaps_sides(ImageTurn turn) noexcept {
  return turn >= 5;
}

[[nodiscard]] cv::Size turned_size(cv::Size stored, ImageTurn turn);
[[nodiscard]] cv::Mat turned_image(const cv::Mat& stored, ImageTurn turn);
// "by 90 degrees", for people.
[[nodiscard]] const char* turn_text(ImageTurn turn);

}  // namespace sslam::cli
