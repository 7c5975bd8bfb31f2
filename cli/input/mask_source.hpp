// SPDX-License-Identifier: BSD-3-Clause
// What --mask names: one mask for all frames, or a folder with one for each. Pixels of 0 are left out.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

namespace sslam::cli {

class MaskSource {
 public:
  MaskSource() = default;  // leaves nothing out
  // `size`: of the images. Throws Error when a mask for all frames does not do.
  MaskSource(const std::filesystem::path& path, cv::Size size);

  // For the frame with this stem; empty: all of it is used, with the reason in `why` where a mask was
  // expected.
  [[nodiscard]] cv::Mat of(const std::string& stem, std::string& why) const;

 private:
  [[nodiscard]] cv::Mat load(const std::filesystem::path& file, std::string& why) const;

  std::filesystem::path folder_;  // empty: none
  cv::Size size_;
  cv::Mat all_;
};

}  // namespace sslam::cli
