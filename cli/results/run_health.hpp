// SPDX-License-Identifier: BSD-3-Clause
// Whether a run goes as it should, for programs that watch over it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cli/results/frame_record.hpp"

namespace sslam::cli {

// Of a run that is over, or as it stands: docs/automation.md says which members there are.
[[nodiscard]] nlohmann::ordered_json health_json(const RunOutcome& outcome);

}  // namespace sslam::cli
