// SPDX-License-Identifier: BSD-3-Clause
// What metrics.json says of a run.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "cli/results/run_report.hpp"
#include "sslam/io/evaluation/evaluation.hpp"

namespace sslam::cli {

// Nothing where there is no ground truth.
struct RunEvaluations {
  std::optional<io::Evaluation> trajectory;
  std::optional<io::Evaluation> live;    // of the poses that were reported when their frames were tracked
  std::optional<io::Evaluation> metric;  // of the trajectory, with its own scale where that is in metres
};

// What was asked for, as metrics.json has it; the parameters come from the outcome.
[[nodiscard]] nlohmann::ordered_json settings_json(const RunContext& context);

// All but the checksums of the files.
[[nodiscard]] nlohmann::ordered_json metrics_json(const RunContext& context, const RunOutcome& outcome,
                                                  std::size_t tracked_live,
                                                  const RunEvaluations& evaluations);

}  // namespace sslam::cli
