// SPDX-License-Identifier: BSD-3-Clause
#include "cli/run/run_input.hpp"

#include <cstddef>
#include <string>

#include "cli/run/run_check.hpp"
#include "cli/shell/messages.hpp"
#include "cli/stream/stream_name.hpp"

namespace sslam::cli {
namespace {

// A source of normals that gives nothing, view after view, is wrong as a whole: its manifest, or its scale.
void warn_of_useless_normals(const std::string& source, RunOutcome& outcome) {
  constexpr std::size_t kEnough = 10;  // frames, to tell a fault from a view of clutter
  std::size_t asked = 0;
  bool any = false;
  for (const FrameRecord& frame : outcome.frames) {
    if (frame.normal_need == NormalNeed::kNotNeeded) continue;
    ++asked;
    any = any || frame.normal_status == NormalStatus::kOk;
  }
  if (any || asked < kEnough) return;
  outcome.warnings.push_back("--normals " + source + ": not one of " + std::to_string(asked) +
                             " frames has usable normals; `sslam normals` shows the output of a network");
}

void note_stream(const LiveSource& source, RunOutcome& outcome) {
  const StreamFigures figures = source.figures();
  outcome.frames_dropped = figures.dropped;
  outcome.stream_losses = figures.lost;
  if (!figures.end.empty()) outcome.warnings.push_back(figures.end);
}

}  // namespace

void RunInput::open(RunSettings& settings) {
  if (const std::optional<StreamName> stream = stream_named(settings.dataset)) {
    source.emplace(*stream, StreamOptions{settings.live, settings.retry, settings.frame_rate, settings.slice,
                                          size_of_stream_camera(settings)});
    const cv::Size size = source->wait_for_first();
    dataset = source->dataset();
    settings.dataset = dataset.root.string();
    camera = choose_stream_camera(settings, dataset, size);
  } else {
    dataset = open_run_dataset(settings);
    camera = choose_run_camera(settings, dataset);
  }
  print_notes(camera.notes);
  print_warnings(camera.warnings);
}

void RunInput::choose_pixels(const RunSettings& settings) {
  check_wide(settings, camera);
  if (camera.wide) view.emplace(*camera.wide, camera.view_fov);
  if (!settings.mask.empty()) masks = MaskSource(settings.mask, {camera.camera.width, camera.camera.height});
  print_warnings(masks.warnings());
}

FrameStreamOptions RunInput::frames(Recording* recording) {
  return {0, masks, view ? &*view : nullptr, source ? &*source : nullptr, recording};
}

void RunInput::report(const std::string& normals, RunOutcome& outcome) const {
  if (source) note_stream(*source, outcome);
  warn_of_useless_normals(normals, outcome);
}

}  // namespace sslam::cli
