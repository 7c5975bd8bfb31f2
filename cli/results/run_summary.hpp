// SPDX-License-Identifier: BSD-3-Clause
// What people are told of a run that is over.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cli/results/run_metrics.hpp"

namespace sslam::cli {

// `metrics`: as metrics_json has them.
void print_run_summary(const RunContext& context, const RunOutcome& outcome,
                       const nlohmann::ordered_json& metrics, const RunEvaluations& evaluations);

}  // namespace sslam::cli
