// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/run_report.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>

#include "cli/dense/dense_result.hpp"
#include "cli/input/camera_yaml.hpp"
#include "cli/results/eval_report.hpp"
#include "cli/results/frame_table.hpp"
#include "cli/results/map_ply.hpp"
#include "cli/results/result_set.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/results/run_metrics.hpp"
#include "cli/results/run_summary.hpp"
#include "cli/results/truth_source.hpp"
#include "cli/results/view_file.hpp"
#include "cli/shell/messages.hpp"
#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/io/files/csv_writer.hpp"
#include "sslam/io/files/output_file.hpp"
#include "sslam/io/maps/map_file.hpp"
#include "sslam/io/plots/comparison_view.hpp"
#include "sslam/io/plots/svg_plot.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void write_frames(const fs::path& path, const RunOutcome& outcome) {
  io::CsvWriter csv(path, frame_columns());
  for (const FrameRecord& frame : outcome.frames) csv.row(frame_cells(frame));
  csv.commit();
}

std::optional<io::Evaluation> evaluate_run(const RunContext& context, const io::Trajectory& trajectory,
                                           io::Alignment alignment = io::Alignment::kSim3) {
  if (context.dataset.ground_truth.empty() || trajectory.size() < 3) return std::nullopt;
  io::EvaluationOptions options;
  options.alignment = alignment;
  options.seconds_per_stamp = context.dataset.seconds_per_stamp;
  for (const io::FrameEntry& frame : context.dataset.frames) options.frame_stamps.push_back(frame.stamp);
  try {
    return io::evaluate(context.dataset.ground_truth, trajectory, options);
  } catch (const Error& error) {
    print_warning(std::string("no figures against ground truth: ") + error.what());
    return std::nullopt;
  }
}

// Each pose as it was reported when its frame was tracked. Those in other worlds, as of a map that was given
// up or joined with this one later, have nothing in common with them.
io::Trajectory live_trajectory(const RunOutcome& outcome) {
  io::Trajectory live;
  live.reserve(outcome.frames.size());
  for (const FrameRecord& frame : outcome.frames)
    if (frame.has_pose() && frame.world == outcome.world)
      live.push_back({frame.stamp, frame.cam_from_world.inverse()});
  return live;
}

void write_top_view_file(const fs::path& path, const RunContext& context, const RunOutcome& outcome,
                         const std::optional<io::Evaluation>& evaluation) {
  if (outcome.trajectory.empty()) {
    std::error_code ignored;
    fs::remove(path, ignored);  // of an earlier run into this folder
    return;
  }
  Sim3<double> truth_from_estimate;
  if (evaluation) truth_from_estimate = evaluation->truth_from_estimate;
  io::TopView view = io::comparison_view(context.dataset.ground_truth, outcome.trajectory,
                                         truth_from_estimate, context.dataset.frames.front().stamp,
                                         context.dataset.frames.back().stamp, context.settings.dataset);
  if (!evaluation && !outcome.scale.metric) view.unit = "map units";
  for (const auto& point : outcome.map.points)
    if (point.alive) view.points.push_back(truth_from_estimate * point.position);
  io::write_top_view(path, view);
}

// Where it is another camera than the given one: that of the run, or what its map asks for.
void write_found_camera(const fs::path& path, const RunContext& context, const CalibrationRecord& record) {
  if (!record.replaced && record.last.verdict != CameraVerdict::kDiffers) return;
  CameraFile file;
  file.camera = record.replaced ? context.camera : record.last.camera;
  file.depth_factor = record.depth_factor;
  file.frame_rate = record.frame_rate;
  io::OutputFile out(path);
  out.stream() << camera_yaml(file, "# found by sslam run, from the images\n");
  out.commit();
}

}  // namespace

void write_run(const RunContext& context, const RunOutcome& outcome, const fs::path& out) {
  const std::string unit = unit_comment(outcome.scale);
  io::write_trajectory(out / "trajectory.txt", outcome.trajectory, unit);
  const io::Trajectory live = live_trajectory(outcome);
  io::write_trajectory(out / "trajectory_live.txt", live, unit);
  io::write_trajectory(out / "keyframes.txt", outcome.keyframes, unit);
  write_map_ply(out / "map.ply", outcome.map, outcome.colours, unit);
  if (!outcome.map.empty()) io::save_map(out / "map.sslam", outcome.map);
  if (outcome.colours.any()) write_colours(out / kColourFile, outcome.colours);
  if (const io::Trajectory truth = truth_during(context.dataset, context.dataset.ground_truth);
      !truth.empty())
    io::write_trajectory(out / kTruthFile, truth);
  if (outcome.dense) write_dense(out, *outcome.dense);
  if (!outcome.views.empty()) write_views(out / kViewFile, outcome.views);
  write_frames(out / "frames.csv", outcome);
  RunEvaluations evaluations;
  evaluations.trajectory = evaluate_run(context, outcome.trajectory);
  evaluations.live = evaluate_run(context, live);
  if (outcome.scale.metric && evaluations.trajectory)
    evaluations.metric = evaluate_run(context, outcome.trajectory, io::Alignment::kSe3);
  if (outcome.calibration) write_found_camera(out / kCameraFoundFile, context, *outcome.calibration);
  write_top_view_file(out / kTopViewFile, context, outcome, evaluations.trajectory);
  Json metrics = metrics_json(context, outcome, live.size(), evaluations);
  metrics["files"] = checksums_of(out);
  write_json((out / "metrics.json").string(), metrics);
  print_run_summary(context, outcome, metrics, evaluations);
}

}  // namespace sslam::cli
