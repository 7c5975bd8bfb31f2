// SPDX-License-Identifier: BSD-3-Clause
// The command line `sslam` as a function, for a program that adds presets of its own to it with add_preset:
// link sslam::program.
#pragma once

namespace sslam {

// What main() does; answers with the exit code.
int run_program(int argc, char** argv);

}  // namespace sslam
