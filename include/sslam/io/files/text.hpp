// SPDX-License-Identifier: BSD-3-Clause
// Small text: files read by lines, cells and numbers, independent of the locale, and lists for people.
#pragma once

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/core/error.hpp"
#include "sslam/io/files/pipe_text.hpp"

namespace sslam::io {

// Longer than any list or table of a real recording.
inline constexpr std::size_t kLongestText = std::size_t{1} << 30;

// What is left of an open file. Throws Error when it has more than `most` bytes: a device or a pipe may have
// no end.
[[nodiscard]] inline std::string read_rest(std::istream& file, const std::filesystem::path& path,
                                           std::size_t most) {
  std::string text;
  for (std::vector<char> block(std::size_t{1} << 16); file;) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > most)
      throw Error(path.string() + ": is longer than " + std::to_string(most) + " bytes, or has no end");
  }
  if (file.bad()) throw Error(path.string() + ": cannot read");
  return text;
}

// The whole file. Throws Error when it cannot be read, or has more than `most` bytes.
[[nodiscard]] inline std::string read_text(const std::filesystem::path& path,
                                           std::size_t most = kLongestText) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw Error(path.string() + ": is a folder, expected a file");
  if (is_pipe(path)) return read_pipe(path, most);
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(path.string() + ": cannot open: " + std::strerror(errno != 0 ? errno : ENOENT));
  return read_rest(file, path, most);
}

// The first bytes of a file, at most so many: by default enough to tell what it is. Empty: it cannot be read.
[[nodiscard]] inline std::string first_bytes(const std::filesystem::path& path, std::size_t most = 512) {
  std::string bytes(most, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(most));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

// Between the cells of a row: blanks, tabs and commas, as the TUM tools split them, or semicolons and bars; a
// comma is then left in its cell.
[[nodiscard]] inline std::string_view cell_separators(std::string_view line) noexcept {
  return line.find_first_of(";|") == std::string_view::npos ? " \t\r," : " \t\r;|";
}

// In quotes, single or double, separators are part of a cell.
[[nodiscard]] inline std::vector<std::string_view> split_cells(std::string_view line) {
  const std::string_view separators = cell_separators(line);
  std::vector<std::string_view> cells;
  for (std::size_t at = line.find_first_not_of(separators); at != std::string_view::npos;) {
    const bool quoted = line[at] == '"' || line[at] == '\'';
    const std::size_t close = quoted ? line.find(line[at], at + 1) : std::string_view::npos;
    const bool closed = close != std::string_view::npos;
    const std::size_t start = closed ? at + 1 : at;
    const std::size_t end = closed ? close : std::min(line.find_first_of(separators, at), line.size());
    cells.push_back(line.substr(start, end - start));
    at = line.find_first_not_of(separators, closed ? end + 1 : end);
  }
  return cells;
}

struct TextRow {
  int line = 0;           // counted from 1
  std::string_view text;  // all of it
  std::vector<std::string_view> cells;
};

// Rows that are neither empty nor comments (# or %). They point into text.
[[nodiscard]] inline std::vector<TextRow> split_rows(std::string_view text) {
  std::vector<TextRow> rows;
  int line = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    ++line;
    const std::string_view row = text.substr(at, end - at);
    std::vector<std::string_view> cells = split_cells(row);
    const bool comment = !cells.empty() && (cells.front().starts_with('#') || cells.front().starts_with('%'));
    if (!cells.empty() && !comment) rows.push_back({line, row, std::move(cells)});
    at = end + 1;
  }
  return rows;
}

// Whether a first row names the columns: no digit in it, and not such as "nan" in its first cell.
[[nodiscard]] inline bool is_header(const TextRow& row) {
  constexpr std::string_view kDigits = "0123456789";
  const std::string_view first = row.cells.front();
  const bool number =
      first.find("nan") != std::string_view::npos || first.find("inf") != std::string_view::npos;
  return !number && row.text.find_first_of(kDigits) == std::string_view::npos;
}

// The number that the whole of text spells; "nan" and "inf" are numbers here, the caller decides about them.
template <class Number>
[[nodiscard]] std::optional<Number> parse_number(std::string_view text) noexcept {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// The same, also with a decimal comma, which a cell has only where semicolons or bars separate.
[[nodiscard]] inline std::optional<double> parse_decimal(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return parse_number<double>(text);
  std::string plain(text);
  plain[comma] = '.';
  return text.find('.') == std::string_view::npos ? parse_number<double>(plain) : std::nullopt;
}

// One more item of "a, b, c".
inline void add_to_list(std::string& list, std::string_view item) {
  if (!list.empty()) list += ", ";
  list += item;
}

// The shortest decimal that reads back as the same double, with at least `decimals` digits after the point.
// A published stamp such as 1341836537.655662 therefore comes out as it went in.
[[nodiscard]] inline std::string exact_decimal(double value, std::size_t decimals = 6) {
  char digits[400];
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed);
  std::string text(digits, end);
  if (text.find_first_of("ni") != std::string::npos) return text;  // nan, inf
  std::size_t point = text.find('.');
  if (point == std::string::npos) {
    point = text.size();
    text += '.';
  }
  while (text.size() - point - 1 < decimals) text += '0';
  if (text.ends_with('.')) text.pop_back();
  return text;
}

}  // namespace sslam::io
