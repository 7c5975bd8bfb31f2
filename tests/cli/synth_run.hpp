// SPDX-License-Identifier: BSD-3-Clause
// Runs of `sslam synth` into a folder that goes with the test.
#pragma once

#include <string>

#include "cli/program.hpp"
#include "support/scratch_folder.hpp"

namespace sslam::testing {

[[nodiscard]] inline Outcome synth(const std::string& arguments) {
  return run_program("synth " + arguments);
}

struct SynthScratch : ScratchFolder {
  [[nodiscard]] std::string operator/(const std::string& name) const { return (path() / name).string(); }
};

}  // namespace sslam::testing
