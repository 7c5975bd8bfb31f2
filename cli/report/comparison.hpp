// SPDX-License-Identifier: BSD-3-Clause
// Several runs of one dataset for the page that compares them; cli/report/compare.js is the other end.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace sslam::cli {

struct Comparison {
  nlohmann::ordered_json data;
  std::vector<std::string> warnings;  // files that cannot be used, a line each
};

// The runs in these folders, aligned by similarities to the ground truth where one of them has it, else to
// the first that has a path, with their errors, or how far they are from that one. `page`: the file that will
// link to the runs' own reports. Throws Error where a folder holds no run, and where two runs are of
// different datasets or have no frames in common.
[[nodiscard]] Comparison compare_runs(const std::vector<std::filesystem::path>& folders,
                                      const std::filesystem::path& page);

}  // namespace sslam::cli
