// SPDX-License-Identifier: BSD-3-Clause
// What the process answers to its caller. A command fails by throwing a std::exception whose what() is the
// one line to print (exit code 1); it stops with another code, and nothing printed, by throwing Stop.
#pragma once

namespace sslam::cli {

enum class ExitCode : int {
  kOk = 0,
  kFailed = 1,         // bad input, unwritable output, no result
  kUsage = 2,          // the command line itself is wrong
  kInterrupted = 130,  // Ctrl-C; what had been computed was written
};

struct Stop {
  ExitCode code = ExitCode::kFailed;
};

}  // namespace sslam::cli
