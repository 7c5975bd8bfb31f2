// SPDX-License-Identifier: BSD-3-Clause
// Calibrations as rows of 'key = value', also below [sections]: INI, TOML, the scene files of ScanNet; and as
// one row of numbers below their names.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/core/error.hpp"
#include "sslam/core/text_tree.hpp"

namespace sslam {
namespace detail {

[[nodiscard]] inline std::string without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

// Of a row without its comment.
[[nodiscard]] inline std::string bare_row(const std::string& line) {
  const std::string row = without_blanks(line);
  if (row.empty() || row[0] == '#' || row[0] == ';' || row[0] == '%') return {};
  return without_blanks(std::string_view(row).substr(0, std::min(row.find(" #"), row.find(" ;"))));
}

// Whether each row assigns a value or begins a section, and one at least assigns.
[[nodiscard]] inline bool is_assigned(const std::string& text) {
  std::istringstream lines(text);
  bool any = false;
  for (std::string line; std::getline(lines, line);) {
    const std::string row = bare_row(line);
    if (row.empty()) continue;
    const std::size_t equals = row.find('=');
    const bool section = row.front() == '[' && row.back() == ']' && equals == std::string::npos;
    const bool assigns = equals != std::string::npos && equals > 0 && row.find(':') > equals;
    if (!section && !assigns) return false;
    any = any || assigns;
  }
  return any;
}

// Lists and quotes are as in YAML. Throws Error in one line.
[[nodiscard]] inline TextNode parse_assigned(const std::string& text, const std::string& file) {
  const auto map_at = [](int line) {
    TextNode map;
    map.kind = TextNode::Kind::kMap;
    map.line = line;
    return map;
  };
  TextNode root = map_at(1);
  const auto add = [&file](TextNode& map, const std::string& key, TextNode value, int line) {
    if (map.has(key))
      throw Error(file + ": line " + std::to_string(line) + ": " + key + " is given a second time");
    value.line = line;
    map.keys.push_back(key);
    map.items.push_back(std::move(value));
  };
  std::istringstream lines(text);
  int number = 0;
  bool in_section = false;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::string row = bare_row(line);
    if (row.empty()) continue;
    const std::size_t equals = row.find('=');
    if (equals == std::string::npos) {
      add(root, without_blanks(std::string_view(row).substr(1, row.size() - 2)), map_at(number), number);
      in_section = true;
      continue;
    }
    const std::string key = without_blanks(std::string_view(row).substr(0, equals));
    const std::string value = without_blanks(std::string_view(row).substr(equals + 1));
    TextNode parsed;
    parsed.kind = TextNode::Kind::kScalar;
    parsed.text = value;
    if (value.find_first_of("[{\"'") == 0) {
      const std::string before(static_cast<std::size_t>(number - 1), '\n');  // for the line in messages
      parsed = TextTree::parse(before + "value: " + value, file).items.front();
    }
    add(in_section ? root.items.back() : root, key, std::move(parsed), number);
  }
  return root;
}

// One row such as "fx=461.5, fy=460.25, ..." as a map in braces; empty: another text.
[[nodiscard]] inline std::string braced_row(const std::string& text) {
  std::string row = without_blanks(std::string_view(text).substr(0, text.find_last_not_of(" \t\n") + 1));
  const auto count = [&row](char c) { return std::count(row.begin(), row.end(), c); };
  constexpr std::ptrdiff_t kNumbers = 4;
  const std::ptrdiff_t named = count('=') + count(':');
  if (!row.starts_with("fx") || row.find('\n') != std::string::npos || named < kNumbers) return {};
  const bool commas = count(',') + count(';') + 1 >= named;
  for (char& c : row) {
    if (c == '=') c = ':';
    if (c == ';') c = ',';
  }
  return commas ? "{" + row + "}" : std::string();
}

// A table with one row of numbers below their names, such as "fx,fy,cx,cy", as a map. Empty: another text.
[[nodiscard]] inline TextNode named_row(const std::string& text) {
  TextNode map;
  const auto cells_of = [](const std::string& line) {
    std::istringstream cells(line);
    return std::vector<std::string>(std::istream_iterator<std::string>(cells),
                                    std::istream_iterator<std::string>());
  };
  std::istringstream lines(text);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; rows.size() < 3 && std::getline(lines, line);) {
    for (char& c : line)
      if (c == ',' || c == ';' || c == '"' || ((c == '#' || c == '%') && rows.empty())) c = ' ';
    if (std::vector<std::string> row = cells_of(line); !row.empty()) rows.push_back(std::move(row));
  }
  if (rows.size() != 2 || rows[0].size() != rows[1].size()) return map;
  map.keys = std::move(rows[0]);
  if (std::none_of(map.keys.begin(), map.keys.end(), [](const std::string& key) { return key == "fx"; }))
    return {};
  map.kind = TextNode::Kind::kMap;
  for (std::string& value : rows[1]) {
    TextNode& item = map.items.emplace_back();
    item.kind = TextNode::Kind::kScalar;
    item.line = 2;
    item.text = std::move(value);
  }
  return map;
}

}  // namespace detail
}  // namespace sslam
