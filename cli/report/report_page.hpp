// SPDX-License-Identifier: BSD-3-Clause
// The pages of reports, built into the program from the files in cli/report.
#pragma once

#include <string_view>

namespace sslam::cli {

// The page in order; the gaps are for the data (JSON) and the views (base64, a line each).
struct ReportPage {
  std::string_view before_data, before_views, after_views;
};

[[nodiscard]] ReportPage report_page();

// That of a comparison, around its data (JSON).
struct ComparePage {
  std::string_view before_data, after_data;
};

[[nodiscard]] ComparePage compare_page();

}  // namespace sslam::cli
