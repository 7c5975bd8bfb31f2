// SPDX-License-Identifier: BSD-3-Clause
// Images that follow each other without anything in between, as ffmpeg -f image2pipe writes them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cli/input/image_header.hpp"

namespace sslam::cli {

// Whether an image begins here whose end can be found: JPEG, PNG, WebP, BMP, PGM or PPM.
[[nodiscard]] bool begins_image(Bytes bytes);

// So many bytes tell.
inline constexpr std::size_t kBytesToTell = 16;

class ImageSplitter {
 public:
  void add(Bytes bytes) { held_.insert(held_.end(), bytes.begin(), bytes.end()); }

  // The next image as the file that it would be, once all of it is there; one that has lost its end, once the
  // next begins. Bytes between images are passed over.
  [[nodiscard]] std::optional<std::vector<std::uint8_t>> next();

  // There is so much without an end that no image is to be expected.
  [[nodiscard]] bool hopeless() const noexcept;

 private:
  std::vector<std::uint8_t> held_;
};

}  // namespace sslam::cli
