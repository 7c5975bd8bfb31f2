// SPDX-License-Identifier: BSD-3-Clause
// Tables with a header row, separated by commas.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sslam/io/files/output_file.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

// What stands for a value in a table: numbers to their last bit, true as 1.
template <class Value>
[[nodiscard]] std::string csv_cell(const Value& value) {
  if constexpr (std::is_same_v<Value, bool>)
    return value ? "1" : "0";
  else if constexpr (std::is_floating_point_v<Value>)
    return exact_decimal(value, 0);
  else if constexpr (std::is_integral_v<Value>)
    return std::to_string(value);
  else
    return std::string(value);
}

class CsvWriter {
 public:
  // Throws Error when the place cannot be written to.
  CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& columns) : file_(path) {
    row(columns);
  }

  template <class... Cells>
  void row(const Cells&... cells) {
    (write_cell(cells), ...);
    end_row();
  }

  void row(const std::vector<std::string>& cells) {
    for (const std::string& cell : cells) write_cell(cell);
    end_row();
  }

  // Throws Error when not all of it could be written.
  void commit() { file_.commit(); }

 private:
  template <class Cell>
  void write_cell(const Cell& cell) {
    if (!first_) file_.stream() << ',';
    first_ = false;
    if constexpr (std::is_arithmetic_v<Cell>)
      file_.stream() << csv_cell(cell);
    else
      write_text(cell);
  }

  // Quoted where a reader would otherwise split it (RFC 4180).
  void write_text(std::string_view text) {
    if (text.find_first_of(",\"\n") == std::string_view::npos) {
      file_.stream() << text;
      return;
    }
    file_.stream() << '"';
    for (const char c : text) file_.stream() << (c == '"' ? "\"\"" : std::string(1, c));
    file_.stream() << '"';
  }

  void end_row() {
    file_.stream() << '\n';
    first_ = true;
  }

  OutputFile file_;
  bool first_ = true;
};

}  // namespace sslam::io
