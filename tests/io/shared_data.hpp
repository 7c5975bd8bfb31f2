// SPDX-License-Identifier: BSD-3-Clause
// Recordings that are too large for this repository: in the folder that SSLAM_DATA names, or beside the
// source tree.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/catch.hpp"

namespace sslam::testing {

[[nodiscard]] inline std::filesystem::path shared_data(const std::string& name) {
  const char* named = std::getenv("SSLAM_DATA");
  const std::filesystem::path beside = std::filesystem::path(__FILE__).parent_path() / "../../../shared/data";
  return (named != nullptr ? std::filesystem::path(named) : beside) / name;
}

// False, and says so, when the recording is not there.
[[nodiscard]] inline bool has_shared_data(const std::string& name) {
  std::error_code ignored;
  if (std::filesystem::is_directory(shared_data(name), ignored)) return true;
  WARN("skipped: no " << shared_data(name).string() << " (set SSLAM_DATA)");
  return false;
}

}  // namespace sslam::testing
