// SPDX-License-Identifier: BSD-3-Clause
// What a page of `sslam report` was given.
#pragma once

#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/scratch_folder.hpp"

namespace sslam::testing {

[[nodiscard]] inline nlohmann::json page_data(const std::filesystem::path& page) {
  const std::string text = text_of(page), begin = "<script id=\"data\" type=\"application/json\">";
  const auto from = text.find(begin) + begin.size();
  return nlohmann::json::parse(text.substr(from, text.find("</script>", from) - from));
}

// RFC 4648, section 4.
[[nodiscard]] inline std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    group = group << 6 | static_cast<unsigned>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> bits & 255);
  }
  return bytes;
}

[[nodiscard]] inline std::vector<float> floats_of(const nlohmann::json& array) {
  const std::string bytes = from_base64(array.at("base64").get<std::string>());
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
  return values;
}

}  // namespace sslam::testing
