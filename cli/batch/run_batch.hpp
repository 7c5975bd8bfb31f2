// SPDX-License-Identifier: BSD-3-Clause
// Runs what of a plan is not done yet, several at a time, each in a process of its own.
#pragma once

#include <cstddef>
#include <filesystem>

#include "cli/batch/plan.hpp"
#include "cli/shell/progress.hpp"

namespace sslam::cli {

struct BatchSettings {
  std::filesystem::path folder;
  Shard shard;
  int jobs = 0;  // runs at a time; 0: one for each core
  Verbosity verbosity = Verbosity::kNormal;
};

struct BatchOutcome {
  std::size_t kept = 0;    // were done before
  std::size_t done = 0;    // are done now
  std::size_t broken = 0;  // of all: ended as they should not
  bool interrupted = false;
};

// A run that is done, by this program and with these arguments, is kept; everything else in its place is
// removed.
[[nodiscard]] BatchOutcome run_batch(const Plan& plan, const BatchSettings& settings);

}  // namespace sslam::cli
