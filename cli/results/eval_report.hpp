// SPDX-License-Identifier: BSD-3-Clause
// An evaluation as people read it and as programs read it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sslam/io/evaluation/evaluation.hpp"

namespace sslam::cli {

// Several lines, the last one ended.
[[nodiscard]] std::string evaluation_table(const io::Evaluation& evaluation);

// Lengths in metres, angles in degrees, as the names of the members say.
[[nodiscard]] nlohmann::ordered_json evaluation_json(const io::Evaluation& evaluation);

// Indented, with a newline at the end. Throws Error when it cannot be written.
void write_json(const std::string& path, const nlohmann::ordered_json& json);

}  // namespace sslam::cli
