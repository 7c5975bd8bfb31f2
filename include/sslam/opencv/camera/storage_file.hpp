// SPDX-License-Identifier: BSD-3-Clause
// Small YAML and JSON files for OpenCV's parser. It goes deeper into the stack with each level of nesting:
// what is large or deep does not get that far.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "sslam/core/error.hpp"

namespace sslam {

namespace storage_detail {

// Whoever counts every bracket and need not know where strings and comments begin cannot be misled by them.
// In YAML, levels without brackets each begin farther to the right, or behind a colon.
[[nodiscard]] inline bool is_flat(std::string_view text) noexcept {
  constexpr std::size_t kBrackets = 256, kIndent = 256, kColons = 64;
  std::size_t brackets = 0, indent = 0, colons = 0;
  bool indented = true;
  for (const char c : text) {
    if (c == '\n') {
      indent = colons = 0;
      indented = true;
      continue;
    }
    indented = indented && std::string_view(" \t-?").find(c) != std::string_view::npos;
    indent += indented ? 1 : 0;
    colons += c == ':' ? 1 : 0;
    brackets += c == '[' || c == '{' ? 1 : 0;
    if (brackets > kBrackets || indent > kIndent || colons > kColons) return false;
  }
  return true;
}

}  // namespace storage_detail

// The file's text, which must not be longer than a megabyte and hardly nested. Throws Error.
[[nodiscard]] inline std::string read_storage_text(const std::filesystem::path& path) {
  constexpr std::size_t kLongest = 1 << 20;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(path.string() + ": cannot be read");
  std::string text(kLongest + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, file.gcount())));
  if (text.empty()) throw Error(path.string() + ": is empty");
  if (text.size() > kLongest)
    throw Error(path.string() + ": is longer than 1 MB; expected a few lines of settings");
  if (!storage_detail::is_flat(text))
    throw Error(path.string() + ": is nested too deeply; expected keys with numbers, names or short lists");
  return text;
}

}  // namespace sslam
