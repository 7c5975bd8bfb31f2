// SPDX-License-Identifier: BSD-3-Clause
// Everything that a suite names, looked at before anything runs.
#pragma once

#include <vector>

#include "cli/batch/suite.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::cli {

// What the evaluation needs to know of a sequence.
struct SequenceFacts {
  io::Trajectory truth;                     // empty: none
  std::vector<std::vector<double>> frames;  // stamps, for each of its starts
};

// One for each sequence of the suite. Throws Error that names file, line and what is wrong.
[[nodiscard]] std::vector<SequenceFacts> check_suite(const Suite& suite);

}  // namespace sslam::cli
