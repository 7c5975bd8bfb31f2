// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/run_summary.hpp"

#include <cstddef>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/dense/dense_result.hpp"
#include "cli/input/camera_yaml.hpp"
#include "cli/input/normal_choice.hpp"
#include "cli/results/eval_report.hpp"
#include "cli/results/map_figures.hpp"
#include "cli/results/run_folder.hpp"

namespace sslam::cli {
namespace {

using Json = nlohmann::ordered_json;

// "normals          computed in 12 of 200 frames: no Manhattan frame yet 1, an axis is open 11"
void print_normals_asked(const Json& asked, std::size_t frames) {
  std::string reasons;
  for (const auto& [reason, count] : asked["reasons"].items())
    reasons += (reasons.empty() ? ": " : ", ") + reason + " " + std::to_string(count.get<std::size_t>());
  std::printf("normals          computed in %zu of %zu frames%s\n", asked["frames"].get<std::size_t>(),
              frames, reasons.c_str());
}

void print_scale(const RunOutcome& outcome, const RunEvaluations& evaluations) {
  if (!outcome.scale.metric) return;
  std::printf("unit             %s\n", scale_text(outcome.scale).c_str());
  if (evaluations.trajectory && evaluations.metric)
    std::printf("metric           position (ATE) %.4f m rmse by se3; the scale is off by %.2f %%\n",
                evaluations.metric->position.rmse,
                100 * (1 / evaluations.trajectory->truth_from_estimate.scale - 1));
}

}  // namespace

void print_run_summary(const RunContext& context, const RunOutcome& outcome,
                       const nlohmann::ordered_json& metrics, const RunEvaluations& evaluations) {
  const Json& times = metrics["times"];
  const std::size_t total = context.dataset.frames.size();
  std::printf("tracked          %zu of %zu frames (%.1f %%), %zu keyframes, %zu points, %zu lines\n",
              outcome.trajectory.size(), total, 100.0 * metrics["share_tracked"].get<double>(),
              outcome.keyframes.size(), count_alive(outcome.map.points), count_alive(outcome.map.lines));
  std::printf("speed            %.1f frames/s; frame time median %.1f ms, p95 %.1f ms\n",
              times["frames_per_second"].get<double>(), times["frame_ms"]["median"].get<double>(),
              times["frame_ms"]["p95"].get<double>());
  if (const int uncertain = metrics["states"]["uncertain"].get<int>(); uncertain > 0)
    std::printf("uncertain        %d of these poses: none of their frames is in the map\n", uncertain);
  if (const int bridged = metrics["bridged"].get<int>(); bridged > 0)
    std::printf("bridged          %d of these poses: rotation measured, position interpolated\n", bridged);
  if (outcome.frames_dropped > 0)
    std::printf("dropped          %zu frames that arrived while the tracker was busy\n",
                outcome.frames_dropped);
  if (outcome.stream_losses > 0)
    std::printf("stream           broke %zu times and was opened again\n", outcome.stream_losses);
  if (context.settings.normals.starts_with(kOnDemand))
    print_normals_asked(metrics["normals_asked"], outcome.frames.size());
  if (const auto count = metrics["frames_without_normal_evidence"].get<std::size_t>(); count > 0)
    std::printf("normals          no Manhattan evidence in %zu of %zu frames: lines alone there\n", count,
                outcome.frames.size());
  if (outcome.keyframes_not_made > 0)
    std::printf("mapping          behind in %d frames that should have become keyframes\n",
                outcome.keyframes_not_made);
  if (const auto loops = metrics["loops"].get<std::size_t>(); loops > 0)
    std::printf("loops closed     %zu\n", loops);
  if (const auto joints = metrics["maps_joined"].get<std::size_t>(); joints > 0)
    std::printf("maps joined      %zu\n", joints);
  if (outcome.apart.maps > 0)
    std::printf("maps apart       %zu, with %zu frames: could not be joined with the map that is written\n",
                outcome.apart.maps, outcome.apart.frames);
  if (outcome.calibration && outcome.calibration->last.verdict != CameraVerdict::kOpen)
    std::printf("camera           by the map: %s\n", camera_text(outcome.calibration->last.camera).c_str());
  if (outcome.read_out > 0)
    std::printf("shutter          rolling: %.0f ms from the first row to the last\n", 1e3 * outcome.read_out);
  print_scale(outcome, evaluations);
  if (outcome.dense && !outcome.dense->empty())
    std::printf("dense            %zu planes from %zu keyframes in %.1f s: %s, %s, %s\n",
                outcome.dense->model.planes.size(), outcome.dense->keyframes, outcome.dense->seconds,
                kModelFile, kModelObjFile, kModelPlyFile);
  if (evaluations.trajectory) std::fputs(evaluation_table(*evaluations.trajectory).c_str(), stdout);
}

}  // namespace sslam::cli
