// SPDX-License-Identifier: BSD-3-Clause
// JSON files from outside.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "sslam/io/files/text.hpp"

namespace sslam::cli {

// The object in the file. Throws Error when it cannot be read, holds none, or is nested so deeply that those
// who walk it would run out of stack.
[[nodiscard]] inline nlohmann::ordered_json read_json_object(const std::filesystem::path& path) {
  using Json = nlohmann::ordered_json;
  constexpr int kDeepest = 64;
  const auto check = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > kDeepest)
      throw Error(path.string() + ": is nested more than " + std::to_string(kDeepest) + " levels deep");
    return true;
  };
  Json json = Json::parse(io::read_text(path), check, false);
  if (!json.is_object()) throw Error(path.string() + ": is no JSON object; truncated?");
  return json;
}

}  // namespace sslam::cli
