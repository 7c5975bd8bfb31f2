// SPDX-License-Identifier: BSD-3-Clause
// The command line `sslam` as a function, for a program that adds its own presets with add_preset. Link
// sslam::program.
#pragma once

namespace sslam {

// Does what main() does; returns the exit code.
int run_program(int argc, char** argv);

}  // namespace sslam
