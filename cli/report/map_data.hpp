// SPDX-License-Identifier: BSD-3-Clause
// The landmarks of a run's map for the report's page.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cli/results/run_folder.hpp"

namespace sslam::cli {

// Points, lines and planes, with their colours, and with the keyframes of this run that see them.
void add_map_data(const RunFolder& run, nlohmann::ordered_json& data);

}  // namespace sslam::cli
