// SPDX-License-Identifier: BSD-3-Clause
// The loop of a run, a template over the preset: frames from the stream through the pipeline into records.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "cli/input/frame_stream.hpp"
#include "cli/results/frame_record.hpp"
#include "cli/results/frame_view.hpp"
#include "cli/results/map_figures.hpp"
#include "cli/run/track_settings.hpp"
#include "cli/shell/interrupt.hpp"
#include "cli/shell/progress.hpp"
#include "sslam/track/parameters.hpp"

namespace sslam::cli {

namespace detail {

constexpr float milliseconds(double seconds) noexcept {
  return static_cast<float>(seconds * 1e3);
}

template <class P>
void collect_map(const P& pipeline, std::size_t known_keyframes, RunOutcome& outcome) {
  const auto& map = pipeline.map();
  outcome.map = map;
  outcome.world = pipeline.world();
  for (const auto& apart : pipeline.atlas.worlds()) {
    ++outcome.maps_apart;
    outcome.frames_apart += apart.log.entries().size();
  }
  outcome.keyframes = keyframe_poses(map, known_keyframes);
  outcome.trajectory.reserve(pipeline.trajectory().entries().size());
  for (const auto& entry : pipeline.trajectory().entries())
    outcome.trajectory.push_back({entry.stamp, pipeline.trajectory().pose(map, entry).inverse()});
  const auto earlier = [](const io::StampedPose& a, const io::StampedPose& b) { return a.stamp < b.stamp; };
  std::stable_sort(outcome.trajectory.begin(), outcome.trajectory.end(), earlier);
}

}  // namespace detail

template <class P>
RunOutcome track_sequence(P& pipeline, FrameStream& stream, const TrackSettings& settings,
                          Progress& progress) {
  write_parameters(settings.parameters, pipeline);
  if constexpr (requires { pipeline.rotation.seed; }) pipeline.rotation.seed = settings.seed;
  if constexpr (requires { pipeline.initialisation.seed; }) pipeline.initialisation.seed = settings.seed;
  if (!settings.map.empty()) pipeline.resume(settings.map);
  RunOutcome outcome;
  outcome.parameters = settings.parameters.entries();
  outcome.frames.reserve(stream.size());
  const Interrupt interrupt;
  WallTimer wall;
  wall.begin();
  ExtractedFrame input;
  while (!Interrupt::asked() && stream.next(input)) {
    if (!input.warning.empty()) outcome.warnings.push_back(input.warning);
    if (!input.usable) continue;
    FrameRecord record;
    record.image = input.image;
    record.points = static_cast<int>(input.frame.points.size());
    record.lines = static_cast<int>(input.frame.lines.size());
    record.normals = static_cast<int>(input.frame.normals.size());
    record.normal_status = input.report.normals;
    record.points_ms = detail::milliseconds(input.report.points_time);
    record.lines_ms = detail::milliseconds(input.report.lines_time);
    record.normals_ms = detail::milliseconds(input.report.normals_time);
    record.extraction_ms = detail::milliseconds(input.report.total_time);
    record.result = pipeline.track(input.frame);
    record.tracking_ms = pipeline.timer.total();
    record.stage_ms = pipeline.timer.milliseconds;
    const std::size_t row = outcome.frames.size();
    const FrameViewInput view{row, input.picture, input.normal_picture, stream.camera(),
                              pipeline.map().world_from_manhattan};
    if (settings.view_stride > 0 && row % settings.view_stride == 0)
      outcome.views.push_back(encode_frame_view(view, pipeline.last_frame()));
    for (const FrameWatcher& watch : settings.watchers)
      watch({record, view, pipeline.last_frame(), pipeline.map(), pipeline.trajectory()});
    progress.show(record);
    outcome.frames.push_back(std::move(record));
  }
  if (pipeline.finish() && !outcome.frames.empty()) outcome.frames.back().result.loop_closed = true;
  if constexpr (requires { pipeline.upkeep.refused(); })
    outcome.keyframes_not_made = pipeline.upkeep.refused();
  outcome.wall_seconds = wall.total() * 1e-3;
  outcome.interrupted = Interrupt::asked();
  progress.finish();
  detail::collect_map(pipeline, settings.map.keyframes.size(), outcome);
  return outcome;
}

// The parameters of a pipeline, none of them set.
template <class P>
ParameterTable parameters_of(const P& pipeline) {
  ParameterTable table;
  collect_parameters(pipeline, table);
  return table;
}

// The same with a pipeline of its own. Without `new_points` there are no points but those that start the map.
template <class P>
RunOutcome run_pipeline(FrameStream& stream, const TrackSettings& settings, Progress& progress,
                        bool new_points = true) {
  P pipeline;
  pipeline.mapping.creation.options.use_points = new_points;
  return track_sequence(pipeline, stream, settings, progress);
}

}  // namespace sslam::cli
