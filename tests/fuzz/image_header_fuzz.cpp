// SPDX-License-Identifier: BSD-3-Clause
// What the headers of images say, before a decoder sees them.
#include <cstddef>
#include <cstdlib>

#include "cli/input/image_header.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const sslam::cli::ImageHeader header = sslam::cli::read_image_header({data, size});
  if (header.turn < 1 || header.turn > 8 || header.size.width < 0 || header.size.height < 0) std::abort();
  return 0;
}
