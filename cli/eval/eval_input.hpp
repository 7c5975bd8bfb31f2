// SPDX-License-Identifier: BSD-3-Clause
// What `sslam eval` compares: a ground truth, and estimates whose stamps are brought to its clock.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/results/image_names.hpp"
#include "cli/results/truth_source.hpp"
#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/io/evaluation/time_offset.hpp"

namespace sslam::cli {

struct EvalSettings {
  std::string truth;
  std::vector<std::string> estimates;
  std::string times;         // of files without stamps; empty: looked for beside them
  double offset = 0;         // added to the stamps of the estimates
  bool find_offset = false;  // and what is found for each of them
  io::EvaluationOptions options;
  std::vector<std::string> deltas;
  FileAxes axes = FileAxes::kAuto;
  std::string json;
  std::string plot;
};

// What the estimates are compared with: poses with stamps, or with the names of images.
struct EvalReference {
  TruthSource source;
  std::optional<NamedPoses> named;
};

[[nodiscard]] EvalReference load_reference(const EvalSettings& settings);

struct EvalPair {
  io::Trajectory truth, estimate;
  std::optional<io::TimeOffset> offset;  // that the estimate was moved by, where it was looked for
};

// Both with stamps of one clock; prints warnings. Throws Error where they cannot be compared.
[[nodiscard]] EvalPair load_pair(const std::string& file, const EvalSettings& settings,
                                 const EvalReference& reference);

}  // namespace sslam::cli
