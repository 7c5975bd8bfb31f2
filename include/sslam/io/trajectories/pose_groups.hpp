// SPDX-License-Identifier: BSD-3-Clause
// Poses that are not a row each: matrices over four rows, the groups of Open3D's trajectory.log, the vertices
// among the rows of a pose graph.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/core/error.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

namespace trajectory_detail {

// Rows of four are those of matrices, or a stamp and a position each: the fourth row of no matrix is 0 0 0 1
// then.
inline void refuse_positions(const std::vector<TextRow>& rows, const std::filesystem::path& path) {
  double last = -std::numeric_limits<double>::infinity();
  for (const TextRow& row : rows) {
    const auto stamp = row.cells.size() == 4 ? parse_number<double>(row.cells[0]) : std::nullopt;
    if (!stamp || !(*stamp > last)) return;
    last = *stamp;
  }
  if (rows.size() > 4)
    throw Error(
        path.string() + ": line " + std::to_string(rows.front().line) +
        ": has a stamp and a position, and no rotation; expected rows of 'stamp tx ty tz qx qy qz qw'");
}

// A matrix over four rows becomes one row.
inline void join_matrices(std::vector<TextRow>& rows) {
  const auto four = [](const TextRow& row) { return row.cells.size() == 4; };
  if (rows.size() % 4 != 0 || !std::all_of(rows.begin(), rows.end(), four)) return;
  for (std::size_t i = 0; i < rows.size() / 4; ++i) {
    TextRow joined = rows[4 * i];
    for (std::size_t j = 1; j < 4; ++j)
      joined.cells.insert(joined.cells.end(), rows[4 * i + j].cells.begin(), rows[4 * i + j].cells.end());
    rows[i] = std::move(joined);
  }
  rows.resize(rows.size() / 4);
}

// Open3D's trajectory.log has three whole numbers above each matrix over four rows. Takes them out, and
// answers with the first of each, the number of the frame; empty: this is another file.
[[nodiscard]] inline std::vector<double> take_log_heads(std::vector<TextRow>& rows) {
  constexpr std::size_t kGroup = 5;
  std::vector<double> numbers;
  if (rows.size() % kGroup != 0) return {};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool head = i % kGroup == 0;
    const std::vector<std::string_view>& cells = rows[i].cells;
    if (cells.size() != (head ? 3U : 4U)) return {};
    if (!head) continue;
    for (const std::string_view cell : cells)
      if (!parse_number<std::int64_t>(cell)) return {};
    numbers.push_back(static_cast<double>(*parse_number<std::int64_t>(cells.front())));
  }
  std::size_t at = 0;
  std::erase_if(rows, [&at](const TextRow&) { return at++ % kGroup == 0; });
  return numbers;
}

// The vertices of a pose graph of g2o become rows without stamps, and its edges go. Answers with their ids;
// empty: this is another file.
[[nodiscard]] inline std::vector<double> take_vertices(std::vector<TextRow>& rows) {
  std::vector<double> ids;
  const auto vertex = [](const TextRow& row) { return row.cells.front() == "VERTEX_SE3:QUAT"; };
  if (std::none_of(rows.begin(), rows.end(), vertex)) return ids;
  std::erase_if(rows, [&](const TextRow& row) {
    return !vertex(row) || row.cells.size() != 9 || !parse_number<std::int64_t>(row.cells[1]);
  });
  ids.reserve(rows.size());
  for (TextRow& row : rows) {
    ids.push_back(static_cast<double>(*parse_number<std::int64_t>(row.cells[1])));
    row.cells.erase(row.cells.begin(), row.cells.begin() + 2);
  }
  return ids;
}

}  // namespace trajectory_detail

}  // namespace sslam::io
