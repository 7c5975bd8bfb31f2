// SPDX-License-Identifier: BSD-3-Clause
// How a run of a batch ended: written into its folder last of all, so that a folder with it is complete.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/batch/plan.hpp"

namespace sslam::cli {

enum class RunEnd {
  kTracked,  // there is a trajectory
  kLost,     // the program did what it should, and tracked nothing
  kBroken,   // it crashed, or could not read or write something
};

struct RunMark {
  RunEnd end = RunEnd::kBroken;
  std::string reason;   // of kLost and kBroken
  double seconds = 0;   // wall clock
  std::string program;  // program_fingerprint() of who ran it
  std::vector<std::string> arguments;
};

// Tells builds of sslam apart: a hash of the program file.
[[nodiscard]] std::string program_fingerprint();

void write_mark(const std::filesystem::path& run_folder, const RunMark& mark);

// Nothing where the folder is not there or not complete.
[[nodiscard]] std::optional<RunMark> read_mark(const std::filesystem::path& run_folder);

// How a run ended that left with this exit code, or was ended by this signal (0: by none).
[[nodiscard]] RunMark judge_run(const std::filesystem::path& run_folder, int exit_code, int signal);

// What the run has printed.
inline constexpr const char* kLogFile = "log.txt";

}  // namespace sslam::cli
