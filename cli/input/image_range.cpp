// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/image_range.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>

namespace sslam::cli {
namespace {

// The value below which this share of the pixels lies.
int value_below(const std::vector<std::size_t>& counts, double share) {
  const auto total = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  const auto wanted = static_cast<std::size_t>(share * static_cast<double>(total));
  std::size_t passed = 0;
  for (std::size_t value = 0; value < counts.size(); ++value) {
    passed += counts[value];
    if (passed > wanted) return static_cast<int>(value);
  }
  return 0;
}

}  // namespace

void ImageRange::add(const cv::Mat& image) {
  const int values = image.cols * image.channels();
  values_ += image.total();
  for (int y = 0; y < image.rows; ++y) {
    const auto* row = image.ptr<std::uint16_t>(y);
    for (int x = 0; x < values; ++x) ++counts_[row[x]];
  }
}

void ImageRange::settle() {
  constexpr double kOutliers = 0.001;  // hot and dead pixels
  constexpr int kFewestBits = 8;
  const int low = value_below(counts_, kOutliers), high = value_below(counts_, 1 - kOutliers);
  // A sensor of so many bits; but values that keep far from black are a band, with room for what comes later.
  const auto bits = static_cast<int>(std::bit_width(static_cast<unsigned>(high)));
  black_ = 0;
  white_ = (1 << std::max(bits, kFewestBits)) - 1;
  if (low > high / 4) {
    const int room = std::max((high - low) / 4, 1);
    black_ = std::max(low - room, 0);
    white_ = std::max(std::min(high + room, 65535), black_ + 255);
  }
}

cv::Mat ImageRange::apply(const cv::Mat& image) const {
  const double scale = 255.0 / (white_ - black_);
  cv::Mat result;
  image.convertTo(result, CV_8U, scale, -scale * black_);
  return result;
}

std::string ImageRange::text() const {
  return std::to_string(black_) + " to " + std::to_string(white_);
}

}  // namespace sslam::cli
