// SPDX-License-Identifier: BSD-3-Clause
// TOML from outside, before a parser sees it.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {

namespace toml_detail {

// Where the string or comment that begins at `at` is over.
[[nodiscard]] inline std::size_t end_of_text(std::string_view toml, std::size_t at) {
  const auto end_of = [&](std::string_view what, std::size_t from) {
    const std::size_t found = toml.find(what, from);
    return found == std::string_view::npos ? toml.size() : found + what.size();
  };
  if (toml[at] == '#') return end_of("\n", at);
  const bool long_one = toml.substr(at, 3) == std::string(3, toml[at]);
  const std::string close(long_one ? 3 : 1, toml[at]);
  std::size_t end = at + close.size();
  while (end < toml.size() && toml.substr(end, close.size()) != close) {
    if (toml[end] == '\n' && !long_one) return end;  // the parser will refuse it
    end += toml[at] == '"' && toml[end] == '\\' ? 2 : 1;
  }
  return std::min(end + close.size(), toml.size());
}

// The most parts that a dotted key has, less one.
[[nodiscard]] inline std::size_t most_dots(std::string_view toml) {
  std::size_t most = 0, dots = 0;
  for (std::size_t at = 0; at < toml.size();) {
    const char c = toml[at];
    if (c == '#' || c == '"' || c == '\'') {
      if (c == '#') dots = 0;
      at = end_of_text(toml, at);
      continue;
    }
    if (std::string_view("=,{}[]\n").find(c) != std::string_view::npos) dots = 0;
    if (c == '.') most = std::max(most, ++dots);
    ++at;
  }
  return most;
}

}  // namespace toml_detail

// The whole file. Throws Error when it cannot be read, is longer than any list of settings, or has keys of so
// many parts that a table for each would overflow the stack; lists within lists are left to the parser.
[[nodiscard]] inline std::string read_toml_text(const std::filesystem::path& path) {
  constexpr std::size_t kLongest = 16 << 20, kMostDots = 16;
  std::string text = io::plain_text(io::read_text(path, kLongest));
  if (toml_detail::most_dots(text) > kMostDots)
    throw Error(path.string() + ": a key has more than " + std::to_string(kMostDots + 1) +
                " parts with dots between them; expected few");
  return text;
}

}  // namespace sslam::cli
