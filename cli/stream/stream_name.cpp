// SPDX-License-Identifier: BSD-3-Clause
#include "cli/stream/stream_name.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "sslam/io/files/files.hpp"

namespace sslam::cli {
namespace {

// As RFC 3986 has it: letters, digits, + - . before "://".
bool has_scheme(const std::string& text) {
  const std::size_t end = text.find("://");
  if (end == std::string::npos || end == 0 || std::isalpha(static_cast<unsigned char>(text[0])) == 0)
    return false;
  return std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.';
  });
}

}  // namespace

std::string shown_name(const StreamName& name) {
  if (name.text == "-") return "standard input";
  std::string text = name.text;
  if (name.kind != StreamKind::kUrl) return text;
  const std::size_t begin = text.find("://") + 3, end = text.find('/', begin), at = text.rfind('@', end);
  const std::size_t colon = text.find(':', begin);
  if (at == std::string::npos || at < begin || colon >= at) return text;
  return text.replace(colon + 1, at - colon - 1, "...");
}

std::optional<StreamName> stream_named(const std::string& text) {
  if (text == "-") return StreamName{StreamKind::kPipe, text};
  if (has_scheme(text)) return StreamName{StreamKind::kUrl, text};
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(text, ignored);
  if (std::filesystem::is_fifo(status)) return StreamName{StreamKind::kPipe, text};
  if (std::filesystem::is_character_file(status)) return StreamName{StreamKind::kDevice, text};
  if (std::filesystem::exists(status)) return std::nullopt;
  const bool device = io::all_digits(text) || text.starts_with("/dev/video");
  return device ? std::optional(StreamName{StreamKind::kDevice, text}) : std::nullopt;
}

}  // namespace sslam::cli
