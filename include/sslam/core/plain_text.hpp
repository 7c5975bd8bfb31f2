// SPDX-License-Identifier: BSD-3-Clause
// Text as people's programs write it: with a byte order mark, in UTF-16, with lines that end in CR or CR LF.
// Here it becomes UTF-8 with LF.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sslam {

namespace plain_text_detail {

inline void add_utf8(std::string& text, char32_t code) {
  const auto add = [&text](char32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) return add(code);
  if (code < 0x800) {
    add(0xC0 | code >> 6);
  } else {
    if (code < 0x10000) {
      add(0xE0 | code >> 12);
    } else {
      add(0xF0 | code >> 18);
      add(0x80 | (code >> 12 & 0x3F));
    }
    add(0x80 | (code >> 6 & 0x3F));
  }
  add(0x80 | (code & 0x3F));
}

// `high`: where the high byte of each pair stands, 0 or 1.
[[nodiscard]] inline std::string from_utf16(std::string_view raw, std::size_t high) {
  const auto unit = [&](std::size_t i) {
    const auto byte = [&](std::size_t at) {
      return static_cast<char32_t>(static_cast<unsigned char>(raw[at]));
    };
    return byte(i + high) << 8 | byte(i + 1 - high);
  };
  std::string text;
  for (std::size_t i = 0; i + 1 < raw.size(); i += 2) {
    char32_t code = unit(i);
    const bool pair = code >= 0xD800 && code < 0xDC00 && i + 3 < raw.size();
    if (pair && unit(i + 2) >= 0xDC00 && unit(i + 2) < 0xE000) {
      code = 0x10000 + ((code - 0xD800) << 10) + (unit(i + 2) - 0xDC00);
      i += 2;
    }
    add_utf8(text, code);
  }
  return text;
}

}  // namespace plain_text_detail

[[nodiscard]] inline std::string plain_text(std::string raw) {
  using namespace std::string_view_literals;
  const std::string_view view = raw;
  // Numbers and names begin with ASCII, so that a zero beside the first two letters tells UTF-16 without its
  // mark.
  const auto zeros_at = [view](std::size_t at) {
    return view.size() >= 4 && view[at] == 0 && view[at + 2] == 0 && view[1 - at] != 0;
  };
  if (view.starts_with("\xFF\xFE"sv)) {
    raw = plain_text_detail::from_utf16(view.substr(2), 1);
  } else if (view.starts_with("\xFE\xFF"sv)) {
    raw = plain_text_detail::from_utf16(view.substr(2), 0);
  } else if (zeros_at(1) || zeros_at(0)) {
    raw = plain_text_detail::from_utf16(view, zeros_at(1) ? 1 : 0);
  } else if (view.starts_with("\xEF\xBB\xBF"sv)) {
    raw.erase(0, 3);
  }
  std::string text;
  text.reserve(raw.size());
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const bool line_end = raw[i] == '\r';
    if (line_end && i + 1 < raw.size() && raw[i + 1] == '\n') ++i;
    text += line_end ? '\n' : raw[i];
  }
  return text;
}

}  // namespace sslam
