// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/run_report.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>
#include <optional>

#include "cli/dense/dense_result.hpp"
#include "cli/input/camera_yaml.hpp"
#include "cli/input/normal_choice.hpp"
#include "cli/results/eval_report.hpp"
#include "cli/results/frame_table.hpp"
#include "cli/results/map_figures.hpp"
#include "cli/results/map_ply.hpp"
#include "cli/results/result_set.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/results/run_health.hpp"
#include "cli/results/truth_source.hpp"
#include "cli/results/view_file.hpp"
#include "cli/shell/messages.hpp"
#include "sslam/io/datasets/bag.hpp"
#include "sslam/io/evaluation/evaluation.hpp"
#include "sslam/io/files/csv_writer.hpp"
#include "sslam/io/files/output_file.hpp"
#include "sslam/io/maps/map_file.hpp"
#include "sslam/io/plots/comparison_view.hpp"
#include "sslam/io/plots/svg_plot.hpp"
#include "sslam/version.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void write_frames(const fs::path& path, const RunOutcome& outcome) {
  io::CsvWriter csv(path, frame_columns());
  for (const FrameRecord& frame : outcome.frames) csv.row(frame_cells(frame));
  csv.commit();
}

// The p-quantile by nearest rank; 0 of nothing.
double quantile(std::vector<double> values, double p) {
  if (values.empty()) return 0;
  const auto at = static_cast<std::size_t>(p * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

Json times_json(const RunOutcome& outcome) {
  std::vector<double> frame, extraction, tracking;
  for (const FrameRecord& f : outcome.frames) {
    frame.push_back(f.frame_ms());
    extraction.push_back(f.extraction_ms);
    tracking.push_back(f.tracking_ms);
  }
  const auto quantiles = [](const std::vector<double>& v) {
    return Json{{"median", quantile(v, 0.5)}, {"p95", quantile(v, 0.95)}, {"max", quantile(v, 1.0)}};
  };
  const double rate =
      outcome.wall_seconds > 0 ? static_cast<double>(outcome.frames.size()) / outcome.wall_seconds : 0;
  return {{"frames_per_second", rate},
          {"wall_seconds", outcome.wall_seconds},
          {"processor_seconds", outcome.processor_seconds},
          {"final_pass_seconds", outcome.final_pass_seconds},
          {"frame_ms", quantiles(frame)},
          {"extraction_ms", quantiles(extraction)},
          {"tracking_ms", quantiles(tracking)}};
}

std::size_t count_frames(const RunOutcome& outcome, bool TrackResult<double>::*mark) {
  return static_cast<std::size_t>(std::count_if(outcome.frames.begin(), outcome.frames.end(),
                                                [mark](const FrameRecord& frame) { return frame.*mark; }));
}
std::size_t count_loops(const RunOutcome& outcome) {
  return count_frames(outcome, &TrackResult<double>::loop_closed);
}
std::size_t count_joints(const RunOutcome& outcome) {
  return count_frames(outcome, &TrackResult<double>::maps_joined);
}

Json states_json(const RunOutcome& outcome) {
  Json states = {{"initialising", 0}, {"manhattan", 0}, {"fallback", 0}, {"uncertain", 0}, {"lost", 0}};
  for (const FrameRecord& f : outcome.frames) states[name(f.state)] = states[name(f.state)].get<int>() + 1;
  return states;
}

std::ptrdiff_t count_uncertain(const RunOutcome& outcome) {
  return std::count_if(outcome.frames.begin(), outcome.frames.end(),
                       [](const FrameRecord& frame) { return frame.state == State::kUncertain; });
}

std::size_t count_normals(const RunOutcome& outcome, NormalStatus status) {
  return static_cast<std::size_t>(
      std::count_if(outcome.frames.begin(), outcome.frames.end(),
                    [status](const FrameRecord& frame) { return frame.normal_status == status; }));
}

Json versions_json() {
  const std::string eigen = std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) +
                            "." + std::to_string(EIGEN_MINOR_VERSION);
  return {{"sslam", SSLAM_VERSION}, {"eigen", eigen}, {"opencv", CV_VERSION}, {"compiler", __VERSION__}};
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

// Of all frames; of none, none.
double share_tracked(const RunContext& context, const RunOutcome& outcome) {
  const std::size_t total = context.dataset.frames.size();
  return total == 0 ? 0 : static_cast<double>(outcome.trajectory.size()) / static_cast<double>(total);
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

std::size_t count_asked(const RunOutcome& outcome, NormalNeed need) {
  return static_cast<std::size_t>(
      std::count_if(outcome.frames.begin(), outcome.frames.end(),
                    [need](const FrameRecord& frame) { return frame.normal_need == need; }));
}

// For how many frames the source of normals was asked, and for which of them why.
Json normals_asked_json(const RunOutcome& outcome) {
  Json reasons = Json::object();
  std::size_t asked = 0;
  for (const NormalNeed need : kNormalNeeds) {
    const std::size_t count = count_asked(outcome, need);
    if (count > 0) reasons[name(need)] = count;
    asked += count;
  }
  return {{"frames", asked}, {"reasons", reasons}};
}

// "normals          asked for in 12 of 200 frames: no Manhattan frame yet 1, an axis is open 11"
void print_normals_asked(const RunOutcome& outcome) {
  const Json asked = normals_asked_json(outcome);
  std::string reasons;
  for (const auto& [reason, count] : asked["reasons"].items())
    reasons += (reasons.empty() ? ": " : ", ") + reason + " " + std::to_string(count.get<std::size_t>());
  std::printf("normals          asked for in %zu of %zu frames%s\n", asked["frames"].get<std::size_t>(),
              outcome.frames.size(), reasons.c_str());
}

// How many frames each fault of the source of normals cost; empty without faults.
Json normal_faults_json(const RunOutcome& outcome) {
  Json faults = Json::object();
  for (const FrameRecord& frame : outcome.frames)
    if (frame.normal_status != NormalStatus::kOk && frame.normal_status != NormalStatus::kNoEvidence) {
      Json& count = faults[name(frame.normal_status)];
      count = count.is_null() ? 1 : count.get<int>() + 1;
    }
  return faults;
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

void print_scale(const RunOutcome& outcome, const std::optional<io::Evaluation>& evaluation,
                 const std::optional<io::Evaluation>& metric) {
  if (!outcome.scale.metric) return;
  std::printf("unit             %s\n", scale_text(outcome.scale).c_str());
  if (evaluation && metric)
    std::printf("metric           position (ATE) %.4f m rmse by se3; the scale is off by %.2f %%\n",
                metric->position.rmse, 100 * (1 / evaluation->truth_from_estimate.scale - 1));
}

void print_summary(const RunContext& context, const RunOutcome& outcome,
                   const std::optional<io::Evaluation>& evaluation,
                   const std::optional<io::Evaluation>& metric) {
  const Json times = times_json(outcome);
  const std::size_t total = context.dataset.frames.size();
  std::printf("tracked          %zu of %zu frames (%.1f %%), %zu keyframes, %zu points, %zu lines\n",
              outcome.trajectory.size(), total, 100.0 * share_tracked(context, outcome),
              outcome.keyframes.size(), count_alive(outcome.map.points), count_alive(outcome.map.lines));
  std::printf("speed            %.1f frames/s; frame time median %.1f ms, p95 %.1f ms\n",
              times["frames_per_second"].get<double>(), times["frame_ms"]["median"].get<double>(),
              times["frame_ms"]["p95"].get<double>());
  if (const auto uncertain = count_uncertain(outcome); uncertain > 0)
    std::printf("uncertain        %td of these poses: none of their frames is in the map\n", uncertain);
  if (outcome.frames_dropped > 0)
    std::printf("dropped          %zu frames that came while the tracker was busy\n", outcome.frames_dropped);
  if (outcome.stream_losses > 0)
    std::printf("stream           broke %zu times and came back\n", outcome.stream_losses);
  if (context.settings.normals.starts_with(kOnDemand)) print_normals_asked(outcome);
  if (const std::size_t count = count_normals(outcome, NormalStatus::kNoEvidence); count > 0)
    std::printf("normals          no Manhattan evidence in %zu of %zu frames: lines alone there\n", count,
                outcome.frames.size());
  if (outcome.keyframes_not_made > 0)
    std::printf("mapping          behind in %d frames that should have become keyframes\n",
                outcome.keyframes_not_made);
  if (const std::size_t loops = count_loops(outcome); loops > 0) std::printf("loops closed     %zu\n", loops);
  if (const std::size_t joints = count_joints(outcome); joints > 0)
    std::printf("maps joined      %zu\n", joints);
  if (outcome.apart.maps > 0)
    std::printf(
        "maps apart       %zu, with %zu frames: no place connects them with the map that is written\n",
        outcome.apart.maps, outcome.apart.frames);
  if (outcome.calibration && outcome.calibration->last.verdict != CameraVerdict::kOpen)
    std::printf("camera           by the map: %s\n", camera_text(outcome.calibration->last.camera).c_str());
  if (outcome.read_out > 0)
    std::printf("shutter          rolling: %.0f ms from the first row to the last\n", 1e3 * outcome.read_out);
  print_scale(outcome, evaluation, metric);
  if (outcome.dense && !outcome.dense->empty())
    std::printf("dense            %zu planes from %zu keyframes in %.1f s: %s, %s, %s\n",
                outcome.dense->model.planes.size(), outcome.dense->keyframes, outcome.dense->seconds,
                kModelFile, kModelObjFile, kModelPlyFile);
  if (evaluation) std::fputs(evaluation_table(*evaluation).c_str(), stdout);
}

}  // namespace

nlohmann::ordered_json settings_json(const RunContext& context) {
  const RunSettings& s = context.settings;
  const Pinhole<double>& pinhole = context.camera.pinhole;
  const RadTan<double>& lens = context.camera.distortion;
  return {{"dataset", s.dataset},
          {"topic", context.dataset.bag ? context.dataset.bag->images.topic : ""},
          {"camera", context.camera_source},
          {"pinhole", {pinhole.fx, pinhole.fy, pinhole.cx, pinhole.cy}},
          {"distortion", {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3}},
          {"undistorted_to_degrees", context.view_fov > 0 ? Json(context.view_fov) : Json()},
          {"image_size", {context.camera.width, context.camera.height}},
          {"working_size", {context.working_camera.width, context.working_camera.height}},
          {"seconds_per_stamp", context.dataset.seconds_per_stamp},
          {"normals", s.normals},
          {"preset", s.preset},
          {"map", s.map},
          {"scale", s.scale},
          {"start", s.slice.start},
          {"end", s.slice.end},
          {"stride", s.slice.stride},
          {"seed", s.seed},
          {"live", s.live},
          {"dense", s.dense},
          {"final_pass", s.final_pass}};
}

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
  const auto evaluation = evaluate_run(context, outcome.trajectory);
  const auto live_evaluation = evaluate_run(context, live);
  const auto metric = outcome.scale.metric && evaluation
                          ? evaluate_run(context, outcome.trajectory, io::Alignment::kSe3)
                          : std::nullopt;
  Json metrics = {{"frames", context.dataset.frames.size()},
                  {"tracked", outcome.trajectory.size()},
                  {"tracked_live", live.size()},
                  {"share_tracked", share_tracked(context, outcome)},
                  {"frames_dropped", outcome.frames_dropped},
                  {"stream_losses", outcome.stream_losses},
                  {"interrupted", outcome.interrupted},
                  {"resumed_at", outcome.resumed_at},
                  {"keyframes", outcome.keyframes.size()},
                  {"keyframes_not_made", outcome.keyframes_not_made},
                  {"read_out_s", outcome.read_out},
                  {"points", count_alive(outcome.map.points)},
                  {"lines", count_alive(outcome.map.lines)},
                  {"planes", count_alive(outcome.map.planes)},
                  {"manhattan_frames", outcome.map.world_from_manhattan.size()},
                  {"loops", count_loops(outcome)},
                  {"world", outcome.world},
                  {"maps_joined", count_joints(outcome)},
                  {"maps_apart", outcome.apart.maps},
                  {"frames_apart", outcome.apart.frames},
                  {"states", states_json(outcome)},
                  {"structure", count_frames(outcome, &TrackResult<double>::structure)},
                  {"normals_asked", normals_asked_json(outcome)},
                  {"frames_without_normal_evidence", count_normals(outcome, NormalStatus::kNoEvidence)},
                  {"normal_faults", normal_faults_json(outcome)},
                  {"times", times_json(outcome)}};
  if (evaluation) metrics["trajectory"] = evaluation_json(*evaluation);
  if (live_evaluation) metrics["trajectory_live"] = evaluation_json(*live_evaluation);
  if (outcome.dense) metrics["dense"] = dense_json(*outcome.dense);
  if (metric) metrics["trajectory_se3"] = evaluation_json(*metric);
  metrics["scale"] = scale_json(outcome.scale);
  metrics["warnings"] = outcome.warnings;
  metrics["health"] = health_json(outcome);
  metrics["checkpoints"] = {{"count", outcome.checkpoints}, {"seconds", outcome.checkpoint_seconds}};
  if (outcome.calibration) {
    metrics["calibration"] = calibration_json(*outcome.calibration);
    write_found_camera(out / kCameraFoundFile, context, *outcome.calibration);
  }
  Json settings = settings_json(context), parameters;
  for (const Parameter& p : outcome.parameters) parameters[p.name] = p.value;
  settings["parameters"] = parameters;
  metrics["settings"] = settings;
  metrics["versions"] = versions_json();
  write_top_view_file(out / kTopViewFile, context, outcome, evaluation);
  metrics["files"] = checksums_of(out);
  write_json((out / "metrics.json").string(), metrics);
  print_summary(context, outcome, evaluation, metric);
}

}  // namespace sslam::cli
