// SPDX-License-Identifier: BSD-3-Clause
// Runs the program under test (SSLAM_COMMAND is its path) and catches what it says.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace sslam::testing {

struct Outcome {
  int code;
  std::string text;  // standard output and error together
};

// By the shell, standard error with standard output.
[[nodiscard]] inline Outcome run_command(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot start " + command);
  std::string text;
  std::array<char, 512> buffer;
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) text += buffer.data();
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text};
}

// `before` stands in front of the program in the shell, such as "ulimit -f 3000; ".
[[nodiscard]] inline Outcome run_program(const std::string& arguments, const std::string& before = "") {
  return run_command(before + std::string(SSLAM_COMMAND) + " " + arguments + " 2>&1");
}

// As by Ctrl-C, a moment after the file or folder `begun` is there; a machine may be so fast that all is done
// by then.
[[nodiscard]] inline Outcome interrupt_program(const std::string& arguments, const std::string& begun) {
  return run_command("exec 2>&1; " + std::string(SSLAM_COMMAND) + " " + arguments +
                     " & while kill -0 $! && ! test -e " + begun +
                     "; do sleep 0.05; done; sleep 0.4; kill -INT $!; wait $!");
}

}  // namespace sslam::testing
