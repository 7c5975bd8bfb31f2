// SPDX-License-Identifier: BSD-3-Clause
// Tables of results as people and their programs want them.
#pragma once

#include <filesystem>
#include <string>

#include "cli/batch/result_table.hpp"

namespace sslam::cli {

[[nodiscard]] std::string markdown_page(const ResultPage& page);
[[nodiscard]] std::string latex_page(const ResultPage& page);
[[nodiscard]] std::string html_page(const ResultPage& page);

// tables.md, tables.tex, tables.html, a CSV file for each table, and runs.csv with a row for each run. Throws
// Error when one cannot be written.
void write_tables(const std::filesystem::path& folder, const Results& results, const ResultPage& page);

}  // namespace sslam::cli
