// SPDX-License-Identifier: BSD-3-Clause
// Tables of poses whose head names their columns: in any order, and with others between them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/io/files/files.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

namespace pose_columns_detail {

inline constexpr std::size_t kColumns = 8;  // stamp tx ty tz qx qy qz qw

inline constexpr std::array<std::string_view, 3> kEulerAngles{"roll", "pitch", "yaw"};

// The place in TUM's order of what a column of this name holds; nothing: another thing.
[[nodiscard]] inline std::optional<std::size_t> place_of(std::string_view column) {
  const std::string name = lower_case(std::string(column));
  const auto has = [&name](std::string_view part) { return name.find(part) != std::string::npos; };
  if (name == "t" || name == "ts" || name.starts_with("time") || name.ends_with("stamp")) return 0;
  constexpr std::string_view kAxes = "xyzw";
  const std::size_t axis = name.empty() ? std::string_view::npos : kAxes.find(name.back());
  if (axis == std::string_view::npos) return std::nullopt;
  if (name.starts_with('q') || has("quat") || has("orientation") || has("rotation")) return 4 + axis;
  const bool short_name = name.size() == 1 || (name.size() < 4 && (name[0] == 't' || name[0] == 'p'));
  const bool position = short_name || name.starts_with("p_") || has("pos") || has("translation");
  return position && axis < 3 ? std::optional(1 + axis) : std::nullopt;
}

// The names in the last line of what stands above the rows; units in brackets are left out.
[[nodiscard]] inline std::vector<std::string> names_in(std::string_view head) {
  head = head.substr(0, head.find_last_not_of("\n ") + 1);
  head.remove_prefix(std::min(head.rfind('\n') + 1, head.size()));
  head.remove_prefix(std::min(head.find_first_not_of("#% "), head.size()));
  std::string bare;
  int depth = 0;
  for (const char c : head) {
    if (c == '[' || c == '(') ++depth;
    if (depth == 0) bare += c;
    if ((c == ']' || c == ')') && depth > 0) --depth;
  }
  std::vector<std::string> names;
  if (bare.starts_with(',') || bare.starts_with(';')) names.emplace_back();  // of the rows' numbers
  for (const std::string_view cell : split_cells(bare)) names.emplace_back(cell);
  return names;
}

// Whether the names are those of three turns, whose order nobody tells.
[[nodiscard]] inline bool name_euler_angles(std::string_view head) {
  const std::vector<std::string> names = names_in(head);
  return std::all_of(kEulerAngles.begin(), kEulerAngles.end(), [&names](std::string_view angle) {
    return std::any_of(names.begin(), names.end(), [angle](const std::string& name) {
      return lower_case(name).find(angle) != std::string::npos;
    });
  });
}

// How many empty cells end a row that commas separate: nothing stands behind its last commas.
[[nodiscard]] inline std::size_t empty_at_end(std::string_view row) noexcept {
  std::size_t count = 0;
  for (std::size_t at = row.size(); at > 0; --at) {
    const char c = row[at - 1];
    if (c == ',' || c == ';' || c == '|')
      ++count;
    else if (c != ' ' && c != '\t' && c != '\r')
      break;
  }
  return count;
}

}  // namespace pose_columns_detail

// Of rows whose columns are named above them, in `head`: brings those of a pose to the front, in TUM's order,
// and answers with the number of columns. 0, with nothing done, where the names do not tell.
inline std::size_t order_columns(std::vector<TextRow>& rows, std::string_view head) {
  using namespace pose_columns_detail;
  const std::vector<std::string> names = names_in(head);
  std::array<std::optional<std::size_t>, kColumns> columns;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (const auto place = place_of(names[i]); place && !columns[*place]) columns[*place] = i;
  if (!std::all_of(columns.begin(), columns.end(), [](const auto& column) { return column.has_value(); }))
    return 0;
  const std::size_t needed = 1 + std::max_element(columns.begin(), columns.end())->value();
  std::size_t ordered = 0;
  for (TextRow& row : rows) {
    const std::size_t empty = empty_at_end(row.text);
    if (row.cells.size() >= needed && row.cells.size() + empty == names.size())
      row.cells.resize(names.size());
    if (row.cells.size() != names.size()) continue;
    std::vector<std::string_view> cells;
    cells.reserve(columns.size());
    for (const auto& column : columns) cells.push_back(row.cells[*column]);
    cells.resize(names.size());  // the others are not looked at
    row.cells = std::move(cells);
    ++ordered;
  }
  return ordered > 0 ? names.size() : 0;
}

}  // namespace sslam::io
