// SPDX-License-Identifier: BSD-3-Clause
// A camera as ROS tells it, in the words of a camera file.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "sslam/io/bags/messages.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

// As a file that --camera takes. Images that were rectified have the camera of the projection, and no lens.
[[nodiscard]] inline std::string camera_text_of(const CameraInfoMessage& info, bool rectified) {
  const auto list = [](const auto& values) {
    std::string text;
    for (const double value : values) add_to_list(text, exact_decimal(value, 1));
    return "[" + text + "]\n";
  };
  std::array<double, 9> k = info.k;
  if (rectified)
    for (std::size_t i = 0; i < 9; ++i) k[i] = info.p[i / 3 * 4 + i % 3];
  std::string text =
      "width: " + std::to_string(info.width) + "\nheight: " + std::to_string(info.height) + "\nK: " + list(k);
  if (rectified || info.d.empty()) return text;
  return text + "distortion_model: " + (info.model.empty() ? "plumb_bob" : "\"" + info.model + "\"") +
         "\nD: " + list(info.d);
}

}  // namespace sslam::io
