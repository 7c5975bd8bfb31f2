// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/ros_image.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "cli/input/image_limit.hpp"

namespace sslam::cli {
namespace {

constexpr int kAsIs = -1;

struct Encoding {
  std::string_view name;  // sensor_msgs/image_encodings.h
  int type;               // as stored
  int to_bgr;             // cv::cvtColor's
};

// OpenCV names a Bayer pattern by its second row and column, ROS by the first.
constexpr std::array kEncodings{
    Encoding{"mono8", CV_8UC1, cv::COLOR_GRAY2BGR},
    Encoding{"8UC1", CV_8UC1, cv::COLOR_GRAY2BGR},
    Encoding{"bgr8", CV_8UC3, kAsIs},
    Encoding{"8UC3", CV_8UC3, kAsIs},
    Encoding{"rgb8", CV_8UC3, cv::COLOR_RGB2BGR},
    Encoding{"bgra8", CV_8UC4, cv::COLOR_BGRA2BGR},
    Encoding{"8UC4", CV_8UC4, cv::COLOR_BGRA2BGR},
    Encoding{"rgba8", CV_8UC4, cv::COLOR_RGBA2BGR},
    Encoding{"mono16", CV_16UC1, cv::COLOR_GRAY2BGR},
    Encoding{"16UC1", CV_16UC1, cv::COLOR_GRAY2BGR},
    Encoding{"bgr16", CV_16UC3, kAsIs},
    Encoding{"rgb16", CV_16UC3, cv::COLOR_RGB2BGR},
    Encoding{"bayer_rggb8", CV_8UC1, cv::COLOR_BayerBG2BGR},
    Encoding{"bayer_bggr8", CV_8UC1, cv::COLOR_BayerRG2BGR},
    Encoding{"bayer_gbrg8", CV_8UC1, cv::COLOR_BayerGR2BGR},
    Encoding{"bayer_grbg8", CV_8UC1, cv::COLOR_BayerGB2BGR},
    Encoding{"bayer_rggb16", CV_16UC1, cv::COLOR_BayerBG2BGR},
    Encoding{"bayer_bggr16", CV_16UC1, cv::COLOR_BayerRG2BGR},
    Encoding{"bayer_gbrg16", CV_16UC1, cv::COLOR_BayerGR2BGR},
    Encoding{"bayer_grbg16", CV_16UC1, cv::COLOR_BayerGB2BGR},
    Encoding{"yuv422", CV_8UC2, cv::COLOR_YUV2BGR_UYVY},
    Encoding{"uyvy", CV_8UC2, cv::COLOR_YUV2BGR_UYVY},
    Encoding{"yuv422_yuy2", CV_8UC2, cv::COLOR_YUV2BGR_YUY2},
    Encoding{"yuyv", CV_8UC2, cv::COLOR_YUV2BGR_YUY2},
};

std::string encoding_list() {
  return "mono8, mono16, rgb8, bgr8, rgba8, bgra8, rgb16, bgr16, bayer_*8, bayer_*16, yuv422, yuv422_yuy2";
}

// Pixels of this type in the order of this machine.
cv::Mat pixels_of(const io::ImageMessage& message, int type, cv::Size expected, std::string& why) {
  const std::uint64_t width = message.width, height = message.height, step = message.step;
  const std::uint64_t row = width * CV_ELEM_SIZE(type);
  if (width == 0 || height == 0) {
    why = "has no pixels";
    return {};
  }
  const bool known = static_cast<int>(width) == expected.width && static_cast<int>(height) == expected.height;
  if (!known && (width > kMostPixels || height > kMostPixels || width * height > kMostPixels)) {
    why = "claims " + std::to_string(width) + "x" + std::to_string(height) + " pixels, more than " +
          std::to_string(kMostPixels / 1'000'000) + " million";
    return {};
  }
  if (step < row || message.data.size() < step * (height - 1) + row) {
    why = "has fewer bytes than " + std::to_string(width) + "x" + std::to_string(height) + " pixels of " +
          io::shown_word(message.encoding) + " need";
    return {};
  }
  cv::Mat image(static_cast<int>(height), static_cast<int>(width), type);
  for (std::uint64_t y = 0; y < height; ++y) {
    auto* const to = image.ptr<char>(static_cast<int>(y));
    std::copy_n(message.data.data() + y * step, row, to);
    const std::size_t size = CV_ELEM_SIZE1(type);
    for (std::size_t x = 0; message.big_endian && size > 1 && x < row; x += size)
      std::reverse(to + x, to + x + size);
  }
  return image;
}

}  // namespace

cv::Mat colour_of(const io::ImageMessage& message, cv::Size expected, std::string& why) {
  const auto* const known = std::find_if(kEncodings.begin(), kEncodings.end(), [&](const Encoding& encoding) {
    return encoding.name == message.encoding;
  });
  if (known == kEncodings.end()) {
    why = "has the encoding " + io::shown_word(message.encoding) + "; read are " + encoding_list();
    return {};
  }
  const cv::Mat stored = pixels_of(message, known->type, expected, why);
  if (stored.empty() || known->to_bgr == kAsIs) return stored;
  const bool pairs = known->type == CV_8UC2, pattern = known->name.starts_with("bayer");
  if ((pairs && stored.cols % 2 != 0) || (pattern && (stored.cols < 2 || stored.rows < 2))) {
    why = "has a size that " + std::string(known->name) + " cannot have";
    return {};
  }
  cv::Mat image;
  cv::cvtColor(stored, image, known->to_bgr);
  return image;
}

cv::Mat depth_of(const io::ImageMessage& message, std::string& why) {
  const bool metres = message.encoding == "32FC1";
  if (!metres && message.encoding != "16UC1" && message.encoding != "mono16") {
    why = "has the encoding " + io::shown_word(message.encoding) + "; depth is 16UC1 or 32FC1";
    return {};
  }
  cv::Mat depth = pixels_of(message, metres ? CV_32FC1 : CV_16UC1, {}, why);
  if (metres && !depth.empty()) cv::patchNaNs(depth, 0);
  return depth;
}

std::string_view depth_file_of(const io::CompressedImageMessage& message) {
  constexpr std::size_t kSettings = 12;  // a format and two numbers, which floats alone need
  const bool settings = message.format.find("compressedDepth") != std::string_view::npos;
  return message.data.substr(settings ? std::min(kSettings, message.data.size()) : 0);
}

}  // namespace sslam::cli
