// SPDX-License-Identifier: BSD-3-Clause
#include "cli/stream/image_splitter.hpp"

#include <algorithm>

namespace sslam::cli {

bool begins_image(Bytes bytes) {
  switch (read_image_header(bytes.first(std::min(bytes.size(), kBytesToTell))).format) {
    case ImageFormat::kJpeg:
    case ImageFormat::kPng:
    case ImageFormat::kWebp:
    case ImageFormat::kBmp:
    case ImageFormat::kPnm:
      return true;
    default:
      return false;
  }
}

std::optional<std::vector<std::uint8_t>> ImageSplitter::next() {
  std::size_t start = 0;
  const Bytes all(held_);
  while (start + kBytesToTell <= all.size() && !begins_image(all.subspan(start))) ++start;
  if (start > 0) held_.erase(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(start));
  if (held_.size() < kBytesToTell) return std::nullopt;
  const std::size_t end = read_image_header(held_).end;
  if (end == 0 || end > held_.size()) return std::nullopt;
  const auto behind = held_.begin() + static_cast<std::ptrdiff_t>(end);
  std::vector<std::uint8_t> image(held_.begin(), behind);
  held_.erase(held_.begin(), behind);
  return image;
}

bool ImageSplitter::hopeless() const noexcept {
  constexpr std::size_t kMost = std::size_t{1} << 27;
  return held_.size() > kMost;
}

}  // namespace sslam::cli
