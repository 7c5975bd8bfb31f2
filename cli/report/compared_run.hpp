// SPDX-License-Identifier: BSD-3-Clause
// Runs that can stand beside each other: those of one dataset.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "cli/results/run_folder.hpp"
#include "sslam/core/types.hpp"

namespace sslam::cli {

inline constexpr std::size_t kFewestPoses = 3;  // that an alignment needs

struct ComparedRun {
  std::filesystem::path folder;
  RunFolder run;               // without its map and pictures
  Vec3<double> up;             // of its map, a unit vector
  std::vector<double> stamps;  // of all its frames, increasing
};

// Throws Error where a folder holds no run or is named twice, and where two runs are of different datasets or
// have no frames in common.
[[nodiscard]] std::vector<ComparedRun> read_comparable_runs(
    const std::vector<std::filesystem::path>& folders);

}  // namespace sslam::cli
