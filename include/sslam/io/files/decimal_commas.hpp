// SPDX-License-Identifier: BSD-3-Clause
// Tables of numbers that are written with decimal commas: 0,5 in place of 0.5.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "sslam/io/files/text.hpp"

namespace sslam::io {

// Whether blanks, tabs, semicolons or bars separate the row's numbers and each comma is within one. Commas
// may also separate: a row in which a number has a point, or two commas, is no such row.
[[nodiscard]] inline bool has_decimal_commas(std::string_view row) {
  constexpr std::string_view kSeparators = " \t;|\r";
  constexpr std::size_t kFewest = 3;
  std::size_t cells = 0, commas = 0;
  for (std::size_t at = row.find_first_not_of(kSeparators); at != std::string_view::npos; ++cells) {
    const std::size_t end = std::min(row.find_first_of(kSeparators, at), row.size());
    const std::string_view cell = row.substr(at, end - at);
    const bool comma = cell.find(',') != std::string_view::npos;
    if (comma && (cell.ends_with(',') || cell.starts_with(','))) return false;
    if (!comma && cell.find('.') != std::string_view::npos) return false;
    if (comma && !parse_decimal(cell)) return false;
    commas += comma ? 1 : 0;
    at = row.find_first_not_of(kSeparators, end);
  }
  return cells >= kFewest && 2 * commas > cells;
}

// The text with points where its first row of numbers has commas.
[[nodiscard]] inline std::string with_decimal_points(std::string text) {
  for (const TextRow& row : split_rows(text)) {
    if (is_header(row)) continue;
    if (!has_decimal_commas(row.text)) return text;
    break;
  }
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (has_decimal_commas(std::string_view(text).substr(at, end - at)))
      std::replace(text.begin() + static_cast<std::ptrdiff_t>(at),
                   text.begin() + static_cast<std::ptrdiff_t>(end), ',', '.');
    at = end + 1;
  }
  return text;
}

}  // namespace sslam::io
