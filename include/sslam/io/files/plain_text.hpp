// SPDX-License-Identifier: BSD-3-Clause
// Text files of any encoding as UTF-8 with LF.
#pragma once

#include <filesystem>
#include <string>

#include "sslam/core/plain_text.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

using sslam::plain_text;

// Throws Error when the file cannot be read.
[[nodiscard]] inline std::string read_plain_text(const std::filesystem::path& path) {
  return plain_text(read_text(path));
}

}  // namespace sslam::io
