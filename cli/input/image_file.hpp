// SPDX-License-Identifier: BSD-3-Clause
// Opens what io only lists: image files, by their content and checked for a lost end, and the frames of a
// video; writes images.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "cli/input/image_header.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/files/output_file.hpp"

namespace sslam::cli {

// Claims more pixels than anybody has; but `expected` many are let in.
[[nodiscard]] bool is_too_large(const ImageHeader& header, cv::Size expected);

// What `bytes` say of the image that they are. False, with the reason in `why`, when there is nothing to
// decode: they have lost their end, or claim more pixels than anybody has; but `expected` many are let in.
[[nodiscard]] bool check_image(const std::filesystem::path& name, const std::vector<std::uint8_t>& bytes,
                               ImageHeader& header, std::string& why, cv::Size expected = {});

// Reads the file and what its bytes say of the image. False, with the reason in `why`, when there is nothing
// to decode: the file is missing, has lost its end, or claims more pixels than anybody has; but `expected`
// many are let in.
[[nodiscard]] bool open_image(const std::filesystem::path& path, std::vector<std::uint8_t>& bytes,
                              ImageHeader& header, std::string& why, cv::Size expected = {});

// What to do with a file that holds several images and is no video.
inline constexpr const char* kTakeApart = "`convert FILE -coalesce FOLDER/%06d.png` of ImageMagick splits it";

// flags as cv::imread takes them; the pixels stay as they are stored. Empty, with the reason in `why`, when
// the file is missing, truncated or no image.
[[nodiscard]] cv::Mat load_image(const std::filesystem::path& path, int flags, std::string& why);

// The same for a file that open_image has read.
[[nodiscard]] cv::Mat decode_image(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes,
                                   const ImageHeader& header, int flags, std::string& why);

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

// parameters as cv::imwrite takes them. The file appears when it is complete. Throws Error when it cannot be
// written.
inline void write_image(const std::filesystem::path& path, const cv::Mat& image,
                        const std::vector<int>& parameters) {
  std::vector<std::uint8_t> bytes;
  bool encoded = false;
  try {
    encoded = cv::imencode(path.extension().string(), image, bytes, parameters);
  } catch (const cv::Exception&) {
  }
  if (!encoded) throw Error(path.string() + ": cannot write this image");
  io::write_text(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

// Asks the container which frames it has and when; at most `at_most` of them, if that is not negative. Throws
// Error when it cannot be opened. Slice after this.
void list_video_frames(io::Dataset& dataset, std::int64_t at_most = -1);

}  // namespace sslam::cli
