// SPDX-License-Identifier: BSD-3-Clause
// The option of those commands that show a page.
#pragma once

#include <CLI/CLI.hpp>

namespace sslam::cli {

// The port must live until the application has been parsed.
inline CLI::Option* add_port_option(CLI::App& command, int& port) {
  return command.add_option("--port", port, "Port of the page, on 127.0.0.1; 0: any free one")
      ->capture_default_str()
      ->check(CLI::Range(0, 65535));
}

}  // namespace sslam::cli
