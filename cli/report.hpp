// SPDX-License-Identifier: BSD-3-Clause
// `report.html`, made from the files of a run.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace sslam::cli {

inline constexpr std::size_t kMaxViews = 1000;  // that a run keeps for its report, however long it is

// The page. data: what report_data gives, which may have members for other kinds of page
// (cli/report/data.js).
[[nodiscard]] std::string report_html(const nlohmann::ordered_json& data,
                                      const std::vector<std::string>& views);

// The page of a run, from its folder, under that folder's name or another; warns about files that cannot be
// used. Throws Error when there is no run.
[[nodiscard]] std::string report_of(const std::filesystem::path& folder, const std::string& name = "");

// Into the run's folder. Throws Error when it cannot be written.
void write_report(const std::filesystem::path& folder, const std::string& page);

}  // namespace sslam::cli
