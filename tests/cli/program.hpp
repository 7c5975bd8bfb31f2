// SPDX-License-Identifier: BSD-3-Clause
// Runs the program under test (SSLAM_COMMAND is its path) and catches what it says.
#pragma once

#include <sys/wait.h>

#include <csignal>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

namespace sslam::testing {

struct Outcome {
  int code;
  std::string text;  // standard output and error together
};

// By the shell, standard error with standard output. `hear` is given each line as it comes.
[[nodiscard]] inline Outcome run_command(const std::string& command,
                                         const std::function<void(const std::string&)>& hear = {}) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot start " + command);
  std::string text, line;
  for (int byte = std::fgetc(pipe); byte != EOF; byte = std::fgetc(pipe)) {
    line += static_cast<char>(byte);
    if (byte != '\n') continue;
    if (hear) hear(line);
    text += std::exchange(line, {});
  }
  text += line;
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text};
}

// `before` stands in front of the program in the shell, such as "ulimit -f 3000; ".
[[nodiscard]] inline Outcome run_program(const std::string& arguments, const std::string& before = "") {
  return run_command(before + std::string(SSLAM_COMMAND) + " " + arguments + " 2>&1");
}

// As by Ctrl-C, as soon as the program tells of its first frame or image, or of another event; it may be so
// fast that all is done by then. What it told of its progress is part of the text.
[[nodiscard]] inline Outcome interrupt_program(const std::string& arguments,
                                               const std::string& event = "\"done\":1,",
                                               int signal = SIGINT) {
  int process = 0;
  const std::string command = "exec 2>&1; echo $$; exec " + std::string(SSLAM_COMMAND) + " " + arguments;
  return run_command(command + " --json-progress", [&](const std::string& line) {
    if (process == 0) {
      process = std::stoi(line);
    } else if (process > 0 && line.find(event) != std::string::npos) {
      kill(std::exchange(process, -1), signal);
    }
  });
}

}  // namespace sslam::testing
