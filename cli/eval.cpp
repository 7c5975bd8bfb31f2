// SPDX-License-Identifier: BSD-3-Clause
// `sslam eval GROUNDTRUTH ESTIMATE...`: how good trajectories are.
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
#include "cli/eval/eval_figure.hpp"
#include "cli/eval/eval_input.hpp"
#include "cli/results/eval_report.hpp"
#include "cli/shell/choice_option.hpp"
#include "cli/shell/exit_code.hpp"
#include "cli/shell/messages.hpp"
#include "cli/shell/number_checks.hpp"
#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/io/plots/comparison_view.hpp"

namespace sslam::cli {
namespace {

const std::map<std::string, io::Alignment> kAlignmentNames{
    {"sim3", io::Alignment::kSim3}, {"se3", io::Alignment::kSe3}, {"none", io::Alignment::kNone}};
const std::map<std::string, FileAxes> kAxesNames{
    {"auto", FileAxes::kAuto}, {"y-down", FileAxes::kYDown}, {"y-up", FileAxes::kYUp}};

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

// What --plot draws.
struct Plotted {
  io::Trajectory truth;
  std::vector<PlottedEstimate> estimates;
};

void note_for_plot(const std::string& file, const EvalPair& both, const io::Evaluation& evaluation,
                   Plotted& plotted) {
  const io::PairedPoses paired = io::pair_poses(both.truth, both.estimate, evaluation.options.max_difference);
  if (plotted.estimates.empty()) plotted.truth = both.truth;
  plotted.estimates.push_back({file, io::aligned(both.estimate, evaluation.truth_from_estimate),
                               io::stamps_of(paired.estimate),
                               io::position_errors(paired, evaluation.truth_from_estimate),
                               io::rotation_errors(paired, io::rotation_offset(paired))});
}

nlohmann::ordered_json eval_one(const std::string& file, const EvalSettings& settings,
                                const EvalReference& reference, Plotted& plotted) {
  const EvalPair both = load_pair(file, settings, reference);
  const std::optional<io::TimeOffset>& offset = both.offset;
  const io::Evaluation evaluation = io::evaluate(both.truth, both.estimate, settings.options);
  if (settings.estimates.size() > 1) std::printf("%s\n", file.c_str());
  if (offset)
    std::printf("time offset      %+.4f, found; correlation of the motions %.3f\n", offset->offset,
                offset->likeness);
  std::fputs(evaluation_table(evaluation).c_str(), stdout);
  if (settings.estimates.size() > 1) std::fputs("\n", stdout);
  if (!settings.plot.empty()) note_for_plot(file, both, evaluation, plotted);
  nlohmann::ordered_json json = {{"ground_truth", settings.truth}, {"estimate", file}};
  if (offset) json["time_offset"] = {{"offset", offset->offset}, {"likeness", offset->likeness}};
  json.update(evaluation_json(evaluation));
  return json;
}

void run_eval(EvalSettings settings) {
  const EvalReference reference = load_reference(settings);
  const TruthSource& truth = reference.source;
  print_warnings(truth.warnings);
  if (truth.mirrored) print_note(settings.truth + ": poses with y up, mirrored to y down (see --axes)");
  io::EvaluationOptions& options = settings.options;
  options.seconds_per_stamp = truth.seconds_per_stamp;
  if (options.frames == 0) options.frame_stamps = truth.frame_stamps;
  if (!settings.deltas.empty()) options.deltas.clear();
  for (const std::string& text : settings.deltas) options.deltas.push_back(parse_delta(text).value());
  Plotted plotted;
  const auto plot = [&] {
    if (!plotted.estimates.empty())
      write_figure(settings.plot, eval_figure(plotted.truth, plotted.estimates, options.seconds_per_stamp));
  };
  if (settings.estimates.size() == 1) {
    const nlohmann::ordered_json json = eval_one(settings.estimates.front(), settings, reference, plotted);
    plot();
    if (!settings.json.empty()) write_json(settings.json, json);
    return;
  }
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const std::string& file : settings.estimates) {
    try {
      all.push_back(eval_one(file, settings, reference, plotted));
    } catch (const Error& error) {
      print_error(error.what());  // the others have their figures nevertheless
    }
  }
  plot();
  if (!settings.json.empty())
    write_json(settings.json, {{"ground_truth", settings.truth}, {"estimates", all}});
  if (all.size() < settings.estimates.size()) throw Stop{ExitCode::kFailed};
}

}  // namespace

void add_eval_command(CLI::App& app) {
  CLI::App* eval = app.add_subcommand("eval", "Compare a trajectory with ground truth (ATE, RPE, rotation)");
  auto settings = std::make_shared<EvalSettings>();
  io::EvaluationOptions& options = settings->options;
  eval->add_option("GROUNDTRUTH", settings->truth,
                   "trajectory (TUM, EuRoC, KITTI, 4x4 matrices, COLMAP's images), or the folder of a "
                   "dataset or a run")
      ->required();
  eval->add_option(
          "ESTIMATE", settings->estimates,
          "trajectories, camera to world, or folders of runs; several are reported one after the other")
      ->required();
  eval->add_option("--times", settings->times,
                   "file of stamps, one a row, for trajectories without any (KITTI)")
      ->type_name("FILE");
  eval->add_option("--offset", settings->offset, "seconds to add to the stamps of ESTIMATE; default 0")
      ->check(finite_number());
  eval->add_flag("--find-offset", settings->find_offset,
                 "find the offset between the clocks from turn rates and speeds, for each ESTIMATE");
  add_choice(*eval, "--align", options.alignment, kAlignmentNames,
             "sim3 (rotation, translation, scale), se3 (no scale) or none; default sim3");
  eval->add_option("--max-difference", options.max_difference,
                   "largest difference between the stamps of a pair; default 0.02")
      ->check(finite_number())
      ->check(CLI::PositiveNumber);
  eval->add_option("--delta", settings->deltas,
                   "steps of the relative error, such as 1f (frames) or 0.5s (seconds); default 1f 1s")
      ->check([](const std::string& text) {
        return parse_delta(text) ? std::string() : "'" + text + "' is not a step such as 1f or 0.5s";
      });
  eval->add_option("--frames", options.frames,
                   "number of images of the sequence; not needed if GROUNDTRUTH is in a dataset")
      ->check(CLI::PositiveNumber);
  add_choice(*eval, "--axes", settings->axes, kAxesNames,
             "axes of GROUNDTRUTH: y-down, y-up (ICL-NUIM as published), auto; default auto");
  eval->add_option("--json", settings->json, "write the figures to this file")->type_name("FILE");
  eval->add_option("--plot", settings->plot,
                   "draw paths, errors, positions and angles on one page: a file .svg, .pdf or .png")
      ->check([](const std::string& file) {
        return is_figure_name(file) ? std::string() : "'" + file + "' does not end in .svg, .pdf or .png";
      })
      ->type_name("FILE");
  eval->callback([settings] { run_eval(*settings); });
}

}  // namespace sslam::cli
