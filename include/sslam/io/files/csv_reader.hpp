// SPDX-License-Identifier: BSD-3-Clause
// Tables with a header row, separated by commas, as CsvWriter writes them (RFC 4180).
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/io/files/bad_entries.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

// All cells lie in one text: a table of a long run has so many that a string for each would cost more than
// what they say.
class CsvTable {
 public:
  std::vector<std::string> columns;

  [[nodiscard]] std::size_t rows() const noexcept {
    return columns.empty() ? 0 : ends_.size() / columns.size();
  }

  // Stands until the next row is added.
  [[nodiscard]] std::string_view cell(std::size_t row, std::size_t column) const noexcept {
    const std::size_t at = row * columns.size() + column, start = at == 0 ? 0 : ends_[at - 1];
    return std::string_view(text_).substr(start, ends_[at] - start);
  }

  // One cell for each column.
  void add_row(const std::vector<std::string>& cells) {
    for (const std::string& cell : cells) {
      text_ += cell;
      ends_.push_back(text_.size());
    }
  }

  // columns.size() where there is none of this name.
  [[nodiscard]] std::size_t column(std::string_view name) const noexcept {
    std::size_t i = 0;
    while (i < columns.size() && columns[i] != name) ++i;
    return i;
  }

 private:
  std::string text_;
  std::vector<std::size_t> ends_;  // of each cell, row after row
};

namespace csv_detail {

// Takes one row from the front of `text`, whose quoted cells may hold line breaks; counts them in `line`.
inline std::vector<std::string> take_row(std::string_view& text, int& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  std::size_t i = 0;
  for (; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') ++line;
    if (c == '"') {
      const bool doubled = quoted && i + 1 < text.size() && text[i + 1] == '"';
      if (doubled) cells.back() += text[++i];
      if (!doubled) quoted = !quoted;
    } else if (quoted) {
      cells.back() += c;
    } else if (c == ',') {
      cells.emplace_back();
    } else if (c == '\n') {
      break;
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  text.remove_prefix(std::min(i + 1, text.size()));
  return cells;
}

}  // namespace csv_detail

// Throws Error when the file cannot be read, has no header, or is no such table; adds to warnings what was
// skipped.
[[nodiscard]] inline CsvTable read_csv(const std::filesystem::path& path, Warnings& warnings) {
  const std::string text = read_text(path);
  std::string_view left = text;
  if (left.empty()) throw Error(path.string() + ": is empty; expected a header row");
  CsvTable table;
  BadEntries bad(path);
  int line = 0;
  table.columns = csv_detail::take_row(left, line);
  std::size_t total = 0;
  while (!left.empty()) {
    const int at = line + 1;
    const std::vector<std::string> cells = csv_detail::take_row(left, line);
    ++total;
    if (cells.size() == table.columns.size()) {
      table.add_row(cells);
    } else {
      bad.add(at, "has " + std::to_string(cells.size()) + " of " + std::to_string(table.columns.size()) +
                      " cells");
    }
  }
  bad.settle(total, warnings);
  return table;
}

}  // namespace sslam::io
