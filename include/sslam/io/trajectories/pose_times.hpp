// SPDX-License-Identifier: BSD-3-Clause
// The times of poses whose rows have none: a file of their own, one a row.
#pragma once

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "sslam/io/files/dated_rows.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

namespace trajectory_detail {

// Where the times of a KITTI file may lie; empty: nowhere.
[[nodiscard]] inline std::filesystem::path find_times(const std::filesystem::path& poses) {
  const std::filesystem::path folder = poses.parent_path();
  const std::string stem = poses.stem().string();
  std::error_code ignored;
  for (const std::filesystem::path& file :
       {folder / (stem + "_times.txt"), folder / "times.txt", folder / "../sequences" / stem / "times.txt"})
    if (file != poses && std::filesystem::is_regular_file(file, ignored)) return file;
  return {};
}

}  // namespace trajectory_detail

// The first column of a list of times, in its own unit; dates in seconds, with a warning.
[[nodiscard]] inline std::vector<double> read_times(const std::filesystem::path& file, Warnings& warnings) {
  const std::string text = with_seconds(read_plain_text(file), file, warnings);
  std::vector<double> times;
  for (const TextRow& row : split_rows(text)) {
    const auto time = parse_number<double>(row.cells.front());
    if (!time || !std::isfinite(*time))
      throw Error(file.string() + ": line " + std::to_string(row.line) + ": expected a time, found '" +
                  std::string(row.cells.front()) + "'");
    times.push_back(*time);
  }
  return times;
}

// In place of a list of times: none is looked for, and poses without stamps are counted.
inline const std::filesystem::path kNoTimes{"-"};

}  // namespace sslam::io
