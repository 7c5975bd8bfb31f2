// SPDX-License-Identifier: BSD-3-Clause
// Keys of a suite that are options of `sslam run`, by their long names: read and checked by what reads that
// command's line.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "cli/batch/suite.hpp"
#include "cli/run.hpp"

namespace sslam::cli {

class SuiteTable;

// Those that belong to a sequence, and those of which a method may have a list: preset, normals and set are
// read by themselves.
inline constexpr std::array<std::string_view, 12> kSequenceOptions{
    "camera",      "start", "end", "stride",        "fps",  "topic",
    "depth-topic", "focal", "fov", "undistort-fov", "mask", "scale"};
inline constexpr std::array<std::string_view, 4> kMethodOptions{"calibration", "longest-side", "live",
                                                                "no-final-pass"};

// What the table says of an option, each value by itself; empty: nothing. Throws Error where `sslam run`
// would not take one.
[[nodiscard]] std::vector<SuiteOption> read_options(SuiteTable& table, std::string_view key);

// As a word of the command line; empty: a flag that is off.
[[nodiscard]] std::string argument_of(const SuiteOption& option);

// What `sslam run` makes of these words. Throws Error, with one line, where it takes them not.
[[nodiscard]] RunSettings parse_run(const std::vector<std::string>& words);

}  // namespace sslam::cli
