// SPDX-License-Identifier: BSD-3-Clause
// What the process answers to its caller. A command fails by throwing a std::exception whose what() is the
// one line to print (exit code 1, or 2 for UsageError); it stops with another code, and nothing printed, by
// throwing Stop.
#pragma once

#include "sslam/core/error.hpp"

namespace sslam::cli {

enum class ExitCode : int {
  kOk = 0,
  kFailed = 1,         // bad input, unwritable output, no result
  kUsage = 2,          // the command line itself is wrong
  kInterrupted = 130,  // Ctrl-C; what had been computed was written
};

// An unknown value: on the command line kUsage, in a file kFailed.
struct UsageError : Error {
  using Error::Error;
};

struct Stop {
  ExitCode code = ExitCode::kFailed;
};

}  // namespace sslam::cli
