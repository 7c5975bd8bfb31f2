// SPDX-License-Identifier: BSD-3-Clause
// The pixels of ROS's image messages.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <string_view>

#include "sslam/io/bags/messages.hpp"

namespace sslam::cli {

// BGR of 8 or 16 bit. Empty, with the reason in `why`, where the message contradicts itself, is of an
// encoding that is not read, or claims more pixels than anybody has; but `expected` many are let in.
[[nodiscard]] cv::Mat colour_of(const io::ImageMessage& message, cv::Size expected, std::string& why);

// Millimetres of 16 bit or metres as floats, with 0 for what was not measured. Empty as above.
[[nodiscard]] cv::Mat depth_of(const io::ImageMessage& message, std::string& why);

// The file in a message of image_transport's compressedDepth, which has its settings in front.
[[nodiscard]] std::string_view depth_file_of(const io::CompressedImageMessage& message);

}  // namespace sslam::cli
