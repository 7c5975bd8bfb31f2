// SPDX-License-Identifier: BSD-3-Clause
// Images by their names alone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sslam::testing {

// PNG images of these names, which have no extension.
[[nodiscard]] inline std::vector<std::filesystem::path> images_named(const std::vector<std::string>& names) {
  std::vector<std::filesystem::path> images;
  for (const std::string& name : names) images.emplace_back(name + ".png");
  return images;
}

inline constexpr double kHalfPastNoon = 1714566615;  // 2024-05-01 12:30:15 UTC

}  // namespace sslam::testing
