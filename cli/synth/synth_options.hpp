// SPDX-License-Identifier: BSD-3-Clause
// What the command line of `sslam synth` can say.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/synth.hpp"

namespace sslam::cli {

// The settings must live until the application has been parsed.
void add_synth_options(CLI::App& synth, SynthSettings& settings);

}  // namespace sslam::cli
