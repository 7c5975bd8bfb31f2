// SPDX-License-Identifier: BSD-3-Clause
// Tells frame numbers from times.
#pragma once

#include <cmath>
#include <filesystem>

#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

// Whether all stamps of a list, its first column, are whole and small: ICL-NUIM's count frames, others are
// times.
[[nodiscard]] inline bool counts_frames(const std::filesystem::path& list) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(list, ignored)) return false;
  const std::string text = read_plain_text(list);
  constexpr double kMostFrames = 1e7;  // four days of them
  bool any = false;
  for (const TextRow& row : split_rows(text)) {
    const auto stamp = parse_number<double>(row.cells[0]);
    if (!stamp) continue;  // left to who reads the list
    if (*stamp != std::floor(*stamp) || *stamp >= kMostFrames) return false;
    any = true;
  }
  return any;
}

}  // namespace sslam::io
