// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/mask_source.hpp"

#include <opencv2/imgcodecs.hpp>
#include <system_error>

#include "cli/input/image_file.hpp"
#include "cli/input/size_text.hpp"
#include "sslam/core/error.hpp"

namespace sslam::cli {

MaskSource::MaskSource(const std::filesystem::path& path, cv::Size size) : size_(size) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    folder_ = path;
    return;
  }
  std::string why;
  all_ = load(path, why);
  if (all_.empty()) throw Error("--mask " + why);
  if (cv::countNonZero(all_) == 0)
    throw Error("--mask " + path.string() + ": leaves every pixel out; 0 is left out, all else is used");
}

cv::Mat MaskSource::of(const std::string& stem, std::string& why) const {
  if (folder_.empty()) return all_;
  return load(folder_ / (stem + ".png"), why);
}

cv::Mat MaskSource::load(const std::filesystem::path& file, std::string& why) const {
  const cv::Mat mask = load_image(file, cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH, why);
  if (mask.empty()) return {};
  if (mask.size() == size_) return mask != 0;
  why = file.string() + ": the mask has " + size_text(mask.size()) + " pixels, and the images " +
        size_text(size_);
  return {};
}

}  // namespace sslam::cli
