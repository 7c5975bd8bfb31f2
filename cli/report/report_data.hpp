// SPDX-License-Identifier: BSD-3-Clause
// What the report's page is given of a run; cli/report/data.js is its other end.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "cli/results/run_folder.hpp"

namespace sslam::cli {

// All but the views. Arrays of numbers are {"type": "f32", "base64": ...}; the world is the map's. Adds to
// run.problems what does not fit together.
[[nodiscard]] nlohmann::ordered_json report_data(RunFolder& run);

// As many of the views, evenly spaced, as fit into the page.
[[nodiscard]] std::vector<std::string_view> choose_views(const std::vector<std::string>& views,
                                                         std::size_t taken);

}  // namespace sslam::cli
