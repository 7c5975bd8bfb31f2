// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/mask_source.hpp"

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <system_error>
#include <vector>

#include "cli/input/image_file.hpp"
#include "cli/input/size_text.hpp"
#include "sslam/core/error.hpp"
#include "sslam/io/files/files.hpp"

namespace sslam::cli {
namespace {

constexpr const char* kMeaning = "0 is left out, all else is used";

// "a.png" of frame a, and COLMAP's "a.jpg.png".
std::string frame_stem(std::filesystem::path name) {
  while (io::is_image_name(name)) name = name.stem();
  return name.string();
}

std::string percent(int part, const cv::Mat& of) {
  return std::to_string(std::lround(100.0 * part / static_cast<double>(of.total()))) + " %";
}

// Where any colour is not 0.
cv::Mat not_black(const cv::Mat& stored) {
  std::vector<cv::Mat> colours;
  cv::split(stored, colours);
  cv::Mat used = colours[0] != 0;
  for (std::size_t i = 1; i < colours.size(); ++i) used |= colours[i] != 0;
  return used;
}

// JPEG makes greys of black beside white. Empty, with the reason in `why`, where there are too many for that.
cv::Mat bright(const cv::Mat& stored, std::string& why) {
  cv::Mat grey = stored;
  if (stored.channels() == 3) cv::cvtColor(stored, grey, cv::COLOR_BGR2GRAY);
  double top = 0;
  cv::minMaxLoc(grey, nullptr, &top);
  constexpr double kBlack = 32, kMostGrey = 0.05;
  if (top < kBlack) return cv::Mat::zeros(grey.size(), CV_8UC1);
  const int between = cv::countNonZero((grey > top / 4) & (grey < top * 3 / 4));
  if (between <= kMostGrey * static_cast<double>(grey.total())) return grey > top / 2;
  why = "is a JPEG, and " + percent(between, grey) + " of it is neither black nor white; store it as PNG";
  return {};
}

}  // namespace

MaskSource::MaskSource(const std::filesystem::path& path, cv::Size size) : size_(size) {
  std::error_code ignored;
  std::filesystem::path first = path;
  if (std::filesystem::is_directory(path, ignored)) {
    folder_ = path;
    for (const auto& file : io::list_files(path, io::is_image_name))
      files_.emplace(frame_stem(file.filename()), file);
    if (files_.empty())
      throw Error("--mask " + path.string() + ": holds no mask; expected NAME.png for each image NAME");
    first = files_.begin()->second;
  }
  std::string why;
  const Mask mask = load(first, why);
  if (mask.used.empty()) throw Error("--mask " + why);
  const std::string name = "--mask " + first.string();
  if (mask.jpeg)
    warnings_.push_back(name + ": is a JPEG, which has no exact 0: what is darker than half is left out");
  if (!folder_.empty()) return;
  all_ = mask.used;
  const int used = cv::countNonZero(all_), pixels = static_cast<int>(all_.total());
  if (used == 0) throw Error(name + ": leaves every pixel out; " + kMeaning);
  if (used == pixels) warnings_.push_back(name + ": leaves nothing out; " + kMeaning);
  if (used < pixels / 4)
    warnings_.push_back(name + ": leaves " + percent(pixels - used, all_) + " of the image out; " + kMeaning);
}

cv::Mat MaskSource::of(const std::string& stem, std::string& why) const {
  if (folder_.empty()) return all_;
  const auto found = files_.find(stem);
  if (found != files_.end()) return load(found->second, why).used;
  why = folder_.string() + ": holds no mask " + stem + ".png";
  return {};
}

MaskSource::Mask MaskSource::load(const std::filesystem::path& file, std::string& why) const {
  Mask mask;
  std::vector<std::uint8_t> bytes;
  ImageHeader header;
  if (!open_image(file, bytes, header, why, size_)) return mask;
  const cv::Mat stored = decode_image(file, bytes, header, cv::IMREAD_UNCHANGED, why);
  if (stored.empty()) return mask;
  constexpr int kWithAlpha = 4;
  std::string problem;
  if (stored.size() != size_) {
    problem = "the mask has " + size_text(stored.size()) + " pixels, and the images " + size_text(size_);
  } else if (stored.channels() == kWithAlpha) {
    problem =
        std::string("the mask has transparency, whose meaning is not defined; store it without: ") + kMeaning;
  } else {
    mask.jpeg = header.format == ImageFormat::kJpeg;
    mask.used = mask.jpeg ? bright(stored, problem) : not_black(stored);
  }
  if (!problem.empty()) why = file.string() + ": " + problem;
  return mask;
}

}  // namespace sslam::cli
