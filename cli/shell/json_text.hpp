// SPDX-License-Identifier: BSD-3-Clause
// JSON as text for files, pages and programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace sslam::cli {

// In one line, or in rows that are `indent` blanks apart. Names of files need not be UTF-8, as JSON must be:
// bytes that are not become U+FFFD.
[[nodiscard]] inline std::string json_text(const nlohmann::ordered_json& json, int indent = -1) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace sslam::cli
