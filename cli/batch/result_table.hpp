// SPDX-License-Identifier: BSD-3-Clause
// Results as tables in the form of the paper's Table II, turned by a quarter: a sequence a row, a method a
// column.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/batch/results.hpp"

namespace sslam::cli {

struct TableCell {
  std::size_t runs = 0;         // planned
  std::size_t done = 0;         // of them
  std::size_t failed = 0;       // of those done
  std::size_t broken = 0;       // of those failed
  std::optional<double> ate;    // median over the runs, in metres; a failed run counts as infinitely bad
  std::optional<double> worst;  // of the runs with a figure
  std::optional<double> share;  // median of the share of frames tracked; nothing over common frames
  std::optional<double> least_share;
  std::optional<double> rotation;    // median, degrees
  std::optional<double> frame_rate;  // median, frames a second
  bool ensemble = false;             // runs from several first frames: their spread is shown
  bool best = false;                 // of its row
};

// A cell's figures as text, without emphasis: "0.0312 (98 %)"; `cross` stands for a failure.
[[nodiscard]] std::string cell_text(const TableCell& cell, const std::string& cross);

// "0.21 deg, 34.0 / s"
[[nodiscard]] std::string rate_text(const TableCell& cell, const std::string& cross);

struct ResultTable {
  std::string file;  // name without extension; empty: it has none
  std::string caption;
  std::string (*text)(const TableCell& cell, const std::string& cross) = cell_text;
  std::vector<std::string> columns;    // methods
  std::vector<std::string> row_names;  // sequences
  std::vector<std::string> row_notes;  // behind the name, such as how many frames count; may be empty
  std::vector<std::vector<TableCell>> rows;
};

struct ReportLink {
  std::string title;
  std::filesystem::path path;  // below the folder of the tables
};

struct ResultPage {
  std::string title;
  std::vector<ResultTable> tables;
  std::vector<ReportLink> reports;
  std::vector<std::string> notes;  // failures and what is not done yet
  std::size_t missing = 0;         // runs that nobody has done yet
};

[[nodiscard]] ResultPage make_page(const Results& results);

// Four digits behind the point.
[[nodiscard]] std::string metres_text(double metres);

}  // namespace sslam::cli
