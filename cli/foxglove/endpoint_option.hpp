// SPDX-License-Identifier: BSD-3-Clause
// --foxglove [[ADDRESS:]PORT]
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "cli/foxglove/endpoint.hpp"

namespace sslam::cli {

// The endpoint must live until the application has been parsed.
inline CLI::Option* add_foxglove_option(CLI::App& command, std::optional<Endpoint>& endpoint) {
  const auto take = [&endpoint](const std::string& text) {
    // Without a value, CLI11 gives an empty text, and a file of settings "true".
    endpoint = text.empty() || text == "true" ? Endpoint() : parse_endpoint(text);
    if (!endpoint)
      throw CLI::ValidationError("--foxglove", "expected PORT or ADDRESS:PORT, as numbers, not " + text +
                                                   "; a dataset goes before --foxglove");
  };
  return command
      .add_option_function<std::string>(
          "--foxglove", take,
          "Send poses, map, images and warnings to Foxglove during the run, by its WebSocket protocol; "
          "[ADDRESS:]PORT, default 127.0.0.1:8765; port 0: any free one")
      ->expected(0, 1)
      ->type_name("PORT");
}

}  // namespace sslam::cli
