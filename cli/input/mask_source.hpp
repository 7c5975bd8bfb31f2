// SPDX-License-Identifier: BSD-3-Clause
// What --mask names: one mask for all frames, or a folder with one for each. Pixels of 0 are left out.
#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <string>

#include "sslam/io/files/bad_entries.hpp"

namespace sslam::cli {

class MaskSource {
 public:
  MaskSource() = default;  // leaves nothing out
  // `size`: of the images. Throws Error when a mask for all frames, or the first of a folder, does not do.
  MaskSource(const std::filesystem::path& path, cv::Size size);

  // What makes one doubt that the masks are meant so.
  [[nodiscard]] const io::Warnings& warnings() const noexcept { return warnings_; }

  // For the frame with this stem; empty: all of it is used, with the reason in `why` where a mask was
  // expected.
  [[nodiscard]] cv::Mat of(const std::string& stem, std::string& why) const;

 private:
  struct Mask {
    cv::Mat used;  // 255, and 0 for what is left out; empty: none can be read
    bool jpeg = false;
  };
  [[nodiscard]] Mask load(const std::filesystem::path& file, std::string& why) const;

  std::filesystem::path folder_;                        // empty: none
  std::map<std::string, std::filesystem::path> files_;  // of the folder, by the stems of their frames
  cv::Size size_;
  cv::Mat all_;
  io::Warnings warnings_;
};

}  // namespace sslam::cli
