// SPDX-License-Identifier: BSD-3-Clause
// One way through a dataset with one camera: the system, and what looks on. Where the camera turns out to be
// another one, there is a second way.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "cli/input/camera_choice.hpp"
#include "cli/input/frame_stream.hpp"
#include "cli/report.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/results/run_report.hpp"
#include "cli/run.hpp"
#include "cli/run/run_recorder.hpp"
#include "cli/run/track_sequence.hpp"
#include "cli/shell/progress.hpp"
#include "cli/video/overlay_video.hpp"
#include "cli/view/live_view.hpp"
#include "sslam/system/system.hpp"

namespace sslam::cli {

class ProgressObserver : public Observer {
 public:
  explicit ProgressObserver(Progress& progress) : progress_(progress) {}
  void frame_tracked(const FrameEvent& event) override { progress_.show(event.report); }

 private:
  Progress& progress_;
};

class RunPass {
 public:
  RunPass(const RunSettings& settings, const io::Dataset& dataset, const CameraChoice& camera,
          Settings wanted)
      : system(std::move(wanted)),
        context{settings, dataset, camera.source, camera.camera, system.camera(), camera.view_fov},
        recorder(system.camera(), dataset.frames.size(), settings.report ? kMaxViews : 0),
        progress_(dataset.frames.size(), settings.verbosity, "run"),
        progress_observer_(progress_) {
    recorder.keep_pictures = settings.dense;
    system.add_observer(recorder);
    if (!settings.video.empty()) system.add_observer(video.emplace(settings.video, dataset, system.camera()));
    if (settings.view) system.add_observer(live.emplace(context, recorder.colours).observer());
    system.add_observer(progress_observer_);
  }

  void go_on_in(Map<double> known) {
    known_keyframes_ = known.keyframes.size();
    recorder.colours.note(known, load_map_colours(context.settings.map, known));
    system.resume(std::move(known));
  }

  // Frames of a stream join the dataset.
  void track(io::Dataset& dataset, FrameStreamOptions options) {
    const bool paced = context.settings.live && !(options.source && options.source->sets_the_pace());
    options.pace = paced ? dataset.seconds_per_stamp : 0;
    FrameStream stream(dataset, system, std::move(options));
    track_sequence(system, stream, recorder, known_keyframes_);
    progress_.finish();
  }

  System system;
  RunContext context;
  RunRecorder recorder;
  std::optional<OverlayVideo> video;
  std::optional<LiveView> live;

 private:
  std::size_t known_keyframes_ = 0;
  Progress progress_;
  ProgressObserver progress_observer_;
};

}  // namespace sslam::cli
