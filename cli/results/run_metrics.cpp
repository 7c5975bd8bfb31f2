// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/run_metrics.hpp"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>
#include <string>
#include <vector>

#include "cli/dense/dense_result.hpp"
#include "cli/results/eval_report.hpp"
#include "cli/results/map_figures.hpp"
#include "cli/results/run_health.hpp"
#include "sslam/io/datasets/bag.hpp"
#include "sslam/version.hpp"

namespace sslam::cli {
namespace {

using Json = nlohmann::ordered_json;

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

std::size_t count_frames(const RunOutcome& outcome, bool FrameRecord::*mark) {
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

// Of all frames; of none, none.
double share_tracked(const RunContext& context, const RunOutcome& outcome) {
  const std::size_t total = context.dataset.frames.size();
  return total == 0 ? 0 : static_cast<double>(outcome.trajectory.size()) / static_cast<double>(total);
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

nlohmann::ordered_json metrics_json(const RunContext& context, const RunOutcome& outcome,
                                    std::size_t tracked_live, const RunEvaluations& evaluations) {
  Json metrics = {{"frames", context.dataset.frames.size()},
                  {"tracked", outcome.trajectory.size()},
                  {"tracked_live", tracked_live},
                  {"bridged", count_frames(outcome, &FrameRecord::bridged)},
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
  if (evaluations.trajectory) metrics["trajectory"] = evaluation_json(*evaluations.trajectory);
  if (evaluations.live) metrics["trajectory_live"] = evaluation_json(*evaluations.live);
  if (outcome.dense) metrics["dense"] = dense_json(*outcome.dense);
  if (evaluations.metric) metrics["trajectory_se3"] = evaluation_json(*evaluations.metric);
  metrics["scale"] = scale_json(outcome.scale);
  metrics["warnings"] = outcome.warnings;
  metrics["health"] = health_json(outcome);
  metrics["checkpoints"] = {{"count", outcome.checkpoints}, {"seconds", outcome.checkpoint_seconds}};
  if (outcome.calibration) metrics["calibration"] = calibration_json(*outcome.calibration);
  Json settings = settings_json(context), parameters;
  for (const Parameter& p : outcome.parameters) parameters[p.name] = p.value;
  settings["parameters"] = parameters;
  metrics["settings"] = settings;
  metrics["versions"] = versions_json();
  return metrics;
}

}  // namespace sslam::cli
