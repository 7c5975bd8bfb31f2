// SPDX-License-Identifier: BSD-3-Clause
// Text files of any encoding as UTF-8 with LF.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

#include "sslam/core/plain_text.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

using sslam::plain_text;

// Zero bytes become question marks: in a message that names a cell they would end it. Throws Error when the
// file cannot be read.
[[nodiscard]] inline std::string read_plain_text(const std::filesystem::path& path) {
  std::string text = plain_text(read_text(path));
  std::replace(text.begin(), text.end(), '\0', '?');
  return text;
}

}  // namespace sslam::io
