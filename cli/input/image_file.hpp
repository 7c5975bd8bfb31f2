// SPDX-License-Identifier: BSD-3-Clause
// Opens what io only lists: image files, checked for a lost end, and the frames of a video; writes images.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/video.hpp"
#include "sslam/io/files/files.hpp"

namespace sslam::cli {

// False when a JPEG or PNG has lost its end: the decoders fill the rest with grey and answer as if all were
// well.
[[nodiscard]] inline bool is_complete_image(const std::filesystem::path& path) {
  constexpr std::streamoff kTail = 64;  // some writers pad after the end marker
  const std::string extension = io::lower_case(path.extension().string());
  const bool jpeg = extension == ".jpg" || extension == ".jpeg";
  if (!jpeg && extension != ".png") return true;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : 0;
  if (size <= 0) return false;
  file.seekg(std::max<std::streamoff>(0, size - kTail));
  const std::string tail{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return tail.find(jpeg ? "\xff\xd9" : "IEND") != std::string::npos;
}

// flags as cv::imread takes them. Empty, with the reason in `why`, when the file is missing, truncated or no
// image.
[[nodiscard]] inline cv::Mat load_image(const std::filesystem::path& path, int flags, std::string& why) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    why = path.string() + ": no such image";
    return {};
  }
  if (!is_complete_image(path)) {
    why = path.string() + ": truncated image";
    return {};
  }
  cv::Mat image;
  try {
    image = cv::imread(path.string(), flags);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) why = path.string() + ": cannot decode this image";
  return image;
}

// As load_image, in the depth image's own type, with 0 for what was not measured.
[[nodiscard]] inline cv::Mat load_depth(const std::filesystem::path& path, io::Layout layout,
                                        std::string& why) {
  cv::Mat depth = load_image(path, cv::IMREAD_UNCHANGED, why);
  // 7-Scenes marks what was not measured with the largest value.
  if (layout == io::Layout::kSevenScenes && depth.type() == CV_16UC1) depth.setTo(0, depth == 65535);
  return depth;
}

// zlib's fastest level: for images that are written once and seldom moved.
[[nodiscard]] inline std::vector<int> fast_png() {
  return {cv::IMWRITE_PNG_COMPRESSION, 1};
}

// parameters as cv::imwrite takes them. Throws Error when the file cannot be written.
inline void write_image(const std::filesystem::path& path, const cv::Mat& image,
                        const std::vector<int>& parameters) {
  bool written = false;
  try {
    written = cv::imwrite(path.string(), image, parameters);
  } catch (const cv::Exception&) {
  }
  if (!written) throw Error(path.string() + ": cannot write this image");
}

// Opens the video once to learn how many frames it has. Throws Error when it cannot. Slice after this.
inline void list_video_frames(io::Dataset& dataset) {
  cv::VideoCapture video;
  if (!video.open(dataset.root.string())) throw Error(dataset.root.string() + ": cannot open this video");
  io::fill_video_frames(dataset, static_cast<std::int64_t>(video.get(cv::CAP_PROP_FRAME_COUNT)),
                        video.get(cv::CAP_PROP_FPS));
}

}  // namespace sslam::cli
