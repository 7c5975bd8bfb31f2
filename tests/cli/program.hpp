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

// `before` stands in front of the program in the shell, such as "timeout -s INT 1 ".
[[nodiscard]] inline Outcome run_program(const std::string& arguments, const std::string& before = "") {
  const std::string command = before + std::string(SSLAM_COMMAND) + " " + arguments + " 2>&1";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot start " + command);
  std::string text;
  std::array<char, 512> buffer;
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) text += buffer.data();
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text};
}

}  // namespace sslam::testing
