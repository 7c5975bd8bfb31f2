// SPDX-License-Identifier: BSD-3-Clause
// Rows of frames.csv by their stamps, and arrays over them.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "cli/results/run_folder.hpp"

namespace sslam::cli {

// The finite stamp of each row that has one, with the row.
template <class Take>
void for_each_stamp(const io::CsvTable& frames, Take take) {
  const std::size_t column = frames.column("stamp");
  for (std::size_t row = 0; row < frames.rows() && column < frames.columns.size(); ++row) {
    const auto stamp = io::parse_number<double>(frames.cell(row, column));
    if (stamp && std::isfinite(*stamp)) take(*stamp, row);
  }
}

class FrameRows {
 public:
  explicit FrameRows(const io::CsvTable& frames) : count_(frames.rows()) {
    for_each_stamp(frames, [&](double stamp, std::size_t row) { row_of_[stamp] = row; });
  }

  // `size` numbers a row, each of them none yet.
  [[nodiscard]] std::vector<double> empty(std::size_t size) const {
    return std::vector<double>(size * count_, std::numeric_limits<double>::quiet_NaN());
  }
  // Of the frame with exactly this stamp: the files of a run have it to the last bit.
  [[nodiscard]] std::optional<std::size_t> row_of(double stamp) const {
    const auto found = row_of_.find(stamp);
    return found == row_of_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  std::size_t count_;
  std::map<double, std::size_t> row_of_;
};

}  // namespace sslam::cli
