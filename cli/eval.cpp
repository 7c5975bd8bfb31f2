// SPDX-License-Identifier: BSD-3-Clause
// `sslam eval GROUNDTRUTH ESTIMATE`: how good a trajectory is.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/results/eval_report.hpp"
#include "cli/results/truth_source.hpp"
#include "cli/shell/choice_option.hpp"
#include "cli/shell/messages.hpp"
#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/io/plots/comparison_view.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"

namespace sslam::cli {
namespace {

const std::map<std::string, io::Alignment> kAlignmentNames{
    {"sim3", io::Alignment::kSim3}, {"se3", io::Alignment::kSe3}, {"none", io::Alignment::kNone}};
const std::map<std::string, FileAxes> kAxesNames{
    {"auto", FileAxes::kAuto}, {"y-down", FileAxes::kYDown}, {"y-up", FileAxes::kYUp}};

struct EvalSettings {
  std::string truth;
  std::string estimate;
  io::EvaluationOptions options;
  std::vector<std::string> deltas;
  FileAxes axes = FileAxes::kAuto;
  std::string json;
  std::string plot;
};

// "30f": 30 frames; "1s" or "1": one second.
std::optional<io::Delta> parse_delta(std::string text) {
  io::Delta delta;
  if (!text.empty() && (text.back() == 'f' || text.back() == 's')) {
    if (text.back() == 'f') delta.unit = io::DeltaUnit::kFrames;
    text.pop_back();
  }
  const auto value = io::parse_number<double>(text);
  const bool whole = value && (delta.unit == io::DeltaUnit::kSeconds || *value == std::floor(*value));
  if (!whole || !std::isfinite(*value) || *value <= 0) return std::nullopt;
  delta.value = *value;
  return delta;
}

void run_eval(EvalSettings settings) {
  const TruthSource truth = load_truth(settings.truth, settings.axes);
  print_warnings(truth.warnings);
  if (truth.mirrored) print_note(settings.truth + ": poses with y up, mirrored to y down (see --axes)");
  io::Warnings warnings;
  const io::Trajectory estimate = io::read_trajectory(settings.estimate, warnings);
  print_warnings(warnings);
  io::EvaluationOptions& options = settings.options;
  options.seconds_per_stamp = truth.seconds_per_stamp;
  if (options.frames == 0) options.frame_stamps = truth.frame_stamps;
  if (!settings.deltas.empty()) options.deltas.clear();
  for (const std::string& text : settings.deltas) options.deltas.push_back(parse_delta(text).value());
  const io::Evaluation evaluation = io::evaluate(truth.trajectory, estimate, options);
  std::fputs(evaluation_table(evaluation).c_str(), stdout);
  if (!settings.json.empty()) {
    nlohmann::ordered_json json = {{"ground_truth", settings.truth}, {"estimate", settings.estimate}};
    json.update(evaluation_json(evaluation));
    write_json(settings.json, json);
  }
  if (!settings.plot.empty()) {
    io::write_top_view(settings.plot,
                       io::comparison_view(truth.trajectory, estimate, evaluation.truth_from_estimate,
                                           estimate.front().stamp, estimate.back().stamp, settings.estimate));
  }
}

}  // namespace

void add_eval_command(CLI::App& app) {
  CLI::App* eval = app.add_subcommand("eval", "Compare a trajectory with ground truth (ATE, RPE, rotation)");
  auto settings = std::make_shared<EvalSettings>();
  io::EvaluationOptions& options = settings->options;
  eval->add_option("GROUNDTRUTH", settings->truth, "trajectory in TUM format, or the folder of a dataset")
      ->required();
  eval->add_option("ESTIMATE", settings->estimate, "trajectory in TUM format, camera to world")->required();
  add_choice(*eval, "--align", options.alignment, kAlignmentNames,
             "sim3 (rotation, translation, scale), se3 (no scale) or none; default sim3");
  eval->add_option("--max-difference", options.max_difference, "between the stamps of a pair; default 0.02")
      ->check(CLI::PositiveNumber);
  eval->add_option("--delta", settings->deltas,
                   "steps of the relative error, such as 1f (frames) or 0.5s (seconds); default 1f 1s")
      ->check([](const std::string& text) {
        return parse_delta(text) ? std::string() : "'" + text + "' is not a step such as 1f or 0.5s";
      });
  eval->add_option("--frames", options.frames,
                   "images that could have been tracked; known by itself when GROUNDTRUTH is in a dataset")
      ->check(CLI::PositiveNumber);
  add_choice(*eval, "--axes", settings->axes, kAxesNames,
             "axes of GROUNDTRUTH: y-down, y-up (ICL-NUIM as published), auto; default auto");
  eval->add_option("--json", settings->json, "write the figures to this file")->type_name("FILE");
  eval->add_option("--plot", settings->plot, "draw both trajectories from above into this SVG file")
      ->type_name("FILE");
  eval->callback([settings] { run_eval(*settings); });
}

}  // namespace sslam::cli
