// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "cli/batch/table_formats.hpp"
#include "cli/results/result_set.hpp"
#include "sslam/io/files/csv_writer.hpp"
#include "sslam/io/files/output_file.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

std::string number(const std::optional<double>& value) {
  if (!value) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.6f", *value);
  return text;
}

// As the table looks, with the figures in full: six columns a method.
void write_table(const fs::path& path, const ResultTable& table) {
  std::vector<std::string> columns{"sequence"};
  for (const std::string& name : table.columns) {
    columns.push_back(name + ": ATE RMSE (m)");
    columns.push_back(name + ": share tracked");
    columns.push_back(name + ": failed runs");
    columns.push_back(name + ": worst ATE RMSE (m)");
    columns.push_back(name + ": least share tracked");
    columns.push_back(name + ": rotation RMSE (deg)");
  }
  io::CsvWriter csv(path, columns);
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    std::vector<std::string> cells{table.row_names[r]};
    for (const TableCell& cell : table.rows[r]) {
      cells.push_back(number(cell.ate));
      cells.push_back(number(cell.share));
      cells.push_back(cell.done > 0 ? std::to_string(cell.failed) : "");
      cells.push_back(number(cell.worst));
      cells.push_back(number(cell.least_share));
      cells.push_back(number(cell.rotation));
    }
    csv.row(cells);
  }
  csv.commit();
}

void write_runs(const fs::path& path, const Results& results) {
  io::CsvWriter csv(path, {"sequence", "method", "run", "state", "ate_rmse_m", "ate_rmse_common_frames_m",
                           "share_tracked", "seconds", "reason", "rotation_rmse_deg", "frames_per_second"});
  for (const ResultSequence& sequence : results.sequences) {
    for (const ResultColumn& column : results.columns) {
      const auto found = column.by_sequence.find(sequence.name);
      if (found == column.by_sequence.end()) continue;
      for (const Estimate& e : found->second) {
        const char* const state =
            !e.done ? "not done" : (e.broken ? "failed" : (e.failed ? "lost" : "tracked"));
        csv.row(sequence.name, column.name, e.title, std::string(state), number(e.ate), number(e.common_ate),
                number(e.share), number(e.seconds), e.reason, number(e.rotation), number(e.frame_rate));
      }
    }
  }
  csv.commit();
}

}  // namespace

void write_tables(const fs::path& folder, const Results& results, const ResultPage& page) {
  ResultSet tables(folder);
  const fs::path& stage = tables.stage();
  io::write_text(stage / "tables.md", markdown_page(page));
  io::write_text(stage / "tables.tex", latex_page(page));
  io::write_text(stage / "tables.html", html_page(page));
  for (const ResultTable& table : page.tables)
    if (!table.file.empty()) write_table(stage / (table.file + ".csv"), table);
  write_runs(stage / "runs.csv", results);
  tables.commit();
}

}  // namespace sslam::cli
