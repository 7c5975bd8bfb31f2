// SPDX-License-Identifier: BSD-3-Clause
#include "cli/batch/result_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "sslam/io/evaluation/statistics.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Nothing where there are no values, or where half of them or more are infinite.
std::optional<double> finite_median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  if (!std::isfinite(values[values.size() / 2])) return std::nullopt;
  return io::quantile(values, 0.5);
}

// Nothing where there are no finite values.
std::optional<double> largest(const std::vector<double>& values) {
  std::optional<double> found;
  for (const double value : values)
    if (std::isfinite(value)) found = std::max(found.value_or(value), value);
  return found;
}

TableCell make_cell(const std::vector<Estimate>& estimates, bool common) {
  TableCell cell;
  std::vector<double> errors, shares, rotations, rates;
  cell.runs = estimates.size();
  for (const Estimate& estimate : estimates) {
    if (!estimate.done) continue;
    ++cell.done;
    cell.failed += estimate.failed ? 1 : 0;
    cell.broken += estimate.broken ? 1 : 0;
    shares.push_back(estimate.share);
    const std::optional<double>& ate = common ? estimate.common_ate : estimate.ate;
    if (estimate.failed) {
      errors.push_back(kInfinity);
      continue;
    }
    if (ate) errors.push_back(*ate);
    if (estimate.rotation) rotations.push_back(*estimate.rotation);
    if (estimate.frame_rate) rates.push_back(*estimate.frame_rate);
  }
  cell.ate = finite_median(errors);
  cell.worst = largest(errors);
  cell.rotation = finite_median(rotations);
  cell.frame_rate = finite_median(rates);
  if (common || shares.empty()) return cell;
  cell.share = finite_median(shares);
  cell.least_share = *std::min_element(shares.begin(), shares.end());
  return cell;
}

// Equal as printed is equal.
void mark_best(std::vector<TableCell>& row) {
  double least = kInfinity;
  for (const TableCell& cell : row)
    if (cell.ate) least = std::min(least, *cell.ate);
  for (TableCell& cell : row) cell.best = cell.ate && metres_text(*cell.ate) == metres_text(least);
}

ResultTable make_table(const Results& results, bool common) {
  ResultTable table;
  for (const ResultColumn& column : results.columns) table.columns.push_back(column.name);
  for (const ResultSequence& sequence : results.sequences) {
    table.row_names.push_back(sequence.name);
    std::size_t total = 0, shared = 0;
    for (const ResultFrames& start : sequence.starts) {
      total += start.stamps.size();
      shared += start.common;
    }
    table.row_notes.push_back(common ? std::to_string(shared) + " of " + std::to_string(total) + " frames"
                                     : (sequence.truth.empty() ? "no ground truth" : ""));
    std::vector<TableCell> row;
    for (const ResultColumn& column : results.columns) {
      const auto found = column.by_sequence.find(sequence.name);
      row.push_back(found == column.by_sequence.end() ? TableCell{} : make_cell(found->second, common));
      row.back().ensemble = sequence.starts.size() > 1;
    }
    mark_best(row);
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string percent(double share, const char* unit = " %") {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f%s", 100 * share, unit);
  return text;
}

void add_notes(const Results& results, ResultPage& page) {
  std::vector<std::string>& notes = page.notes;
  for (const ResultColumn& column : results.columns) {
    for (const ResultSequence& sequence : results.sequences) {
      const auto found = column.by_sequence.find(sequence.name);
      if (found == column.by_sequence.end()) continue;
      for (const Estimate& estimate : found->second) {
        page.missing += estimate.done ? 0 : 1;
        if (!estimate.report.empty()) page.reports.push_back({estimate.title, estimate.report});
        if (estimate.failed)
          notes.push_back((estimate.broken ? "Failed unexpectedly: " : "Lost: ") + estimate.title + ": " +
                          estimate.reason);
      }
    }
  }
  if (page.missing > 0)
    notes.insert(notes.begin(), "Not done yet: " + std::to_string(page.missing) + " runs.");
}

}  // namespace

std::string metres_text(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4f", metres);
  return text;
}

std::string cell_text(const TableCell& cell, const std::string& cross) {
  if (cell.done == 0) return "-";
  std::string share;
  if (cell.share && cell.ensemble)
    share = " (" + percent(*cell.least_share, "") + " / " + percent(*cell.share) + ")";
  if (cell.share && !cell.ensemble) share = " (" + percent(*cell.share) + ")";
  if (cell.failed == cell.done && cell.broken == cell.done) return "failed";
  if (!cell.ate) return (cell.failed > 0 ? cross : "-") + share;
  std::string text = metres_text(*cell.ate);
  if (cell.ensemble) text += " / " + metres_text(*cell.worst);
  text += share;
  if (cell.failed > 0)
    text += ", " + std::to_string(cell.failed) + "/" + std::to_string(cell.done) + " " + cross;
  if (cell.done < cell.runs)
    text += ", " + std::to_string(cell.done) + " of " + std::to_string(cell.runs) + " runs";
  return text;
}

std::string rate_text(const TableCell& cell, const std::string&) {
  char text[64];
  std::string all;
  if (cell.rotation) {
    std::snprintf(text, sizeof text, "%.2f deg", *cell.rotation);
    io::add_to_list(all, text);
  }
  if (cell.frame_rate) {
    std::snprintf(text, sizeof text, "%.1f / s", *cell.frame_rate);
    io::add_to_list(all, text);
  }
  return all.empty() ? "-" : all;
}

ResultPage make_page(const Results& results) {
  ResultPage page;
  page.title = results.name;
  const ResultTable all = make_table(results, false);
  page.tables = {all, make_table(results, true), all};
  page.tables[0].file = "table";
  page.tables[0].caption =
      "Translation RMSE (m) after Sim(3) alignment, median over the runs; in brackets the share of frames "
      "with a pose. Bold: the best of a sequence. \u00d7: lost, with less than " +
      percent(results.min_tracked) + " of the frames tracked.";
  const bool ensemble = std::any_of(results.sequences.begin(), results.sequences.end(),
                                    [](const ResultSequence& s) { return s.starts.size() > 1; });
  if (ensemble)
    page.tables[0].caption +=
        " Of sequences that are run from several first frames: median / worst error, and least / median "
        "share.";
  page.tables[1].file = "common_frames";
  page.tables[1].caption =
      "The same over the frames that have a pose in every run that was not lost, so that no method gains by "
      "leaving out hard frames.";
  ResultTable& rates = page.tables[2];
  rates.caption =
      "Rotation error (RMSE, degrees) after the best constant rotation, and frames per second; "
      "medians over the runs that were not lost.";
  rates.text = rate_text;
  for (std::vector<TableCell>& row : rates.rows)
    for (TableCell& cell : row) cell.best = false;
  add_notes(results, page);
  return page;
}

}  // namespace sslam::cli
