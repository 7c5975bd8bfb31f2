// SPDX-License-Identifier: BSD-3-Clause
// One way through a dataset with one camera: the system, and what looks on. Where the camera turns out to be
// another one, there is a second way.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/input/camera_choice.hpp"
#include "cli/input/frame_stream.hpp"
#include "cli/report.hpp"
#include "cli/results/run_folder.hpp"
#include "cli/results/run_health.hpp"
#include "cli/results/run_report.hpp"
#include "cli/run.hpp"
#include "cli/run/checkpoint_keeper.hpp"
#include "cli/run/run_recorder.hpp"
#include "cli/run/track_sequence.hpp"
#include "cli/shell/interrupt.hpp"
#include "cli/shell/messages.hpp"
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
          Settings wanted, CheckpointHead head)
      : system(std::move(wanted)),
        context{settings, dataset, camera.source, camera.camera, system.camera(), camera.view_fov},
        recorder(system.camera(), dataset.frames.size(), settings.report ? kMaxViews : 0),
        head_(std::move(head)),
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

  // From where another process stood, that tracked the same frames with the same settings.
  void go_on_from(Checkpoint checkpoint) {
    const std::vector<io::FrameEntry>& frames = context.dataset.frames;
    first_ = checkpoint.next;
    print_note("continuing at frame " + std::to_string(first_ + 1) + " of " + std::to_string(frames.size()) +
               ", from the checkpoint in " + context.settings.out);
    known_keyframes_ = checkpoint.known_keyframes;
    recorder.outcome = std::move(checkpoint.outcome);
    recorder.outcome.frames_taken = first_;
    recorder.outcome.resumed_at.push_back(first_ < frames.size() ? frames[first_].index
                                                                 : frames.back().index + 1);
    recorder.colours = std::move(checkpoint.colours);
    system.go_on(std::move(checkpoint.worlds), checkpoint.last_world);
    progress_.begin_at(first_);
  }

  // Frames of a stream join the dataset.
  void track(io::Dataset& dataset, FrameStreamOptions options, const CheckpointClock& checkpoints) {
    const bool paced = context.settings.live && !(options.source && options.source->sets_the_pace());
    options.pace = paced ? dataset.seconds_per_stamp : 0;
    options.first = first_;
    FrameStream stream(dataset, system, std::move(options));
    head_.known_keyframes = known_keyframes_;
    CheckpointKeeper keeper(context.settings.out, checkpoints, head_);
    track_sequence(system, stream, recorder, known_keyframes_, [&] { pass_frame(keeper); });
    progress_.finish();
  }

  void tell_health() { progress_.tell(health_json(recorder.outcome)); }

  // The keyframes before this one are of the map that the run goes on in.
  [[nodiscard]] std::size_t first_keyframe() const noexcept { return known_keyframes_; }

  // A checkpoint of this run lies in its folder.
  [[nodiscard]] bool has_checkpoint() const { return kept_ || !recorder.outcome.resumed_at.empty(); }

  System system;
  RunContext context;
  RunRecorder recorder;
  std::optional<OverlayVideo> video;
  std::optional<LiveView> live;

 private:
  void pass_frame(CheckpointKeeper& keeper) {
    if (keeper.keep(system, recorder, Interrupt::asked())) kept_ = true;
    progress_.tell_now_and_then([&] { return health_json(recorder.outcome); });
  }

  CheckpointHead head_;
  std::size_t first_ = 0;  // position in the dataset of the first frame to track
  std::size_t known_keyframes_ = 0;
  bool kept_ = false;
  Progress progress_;
  ProgressObserver progress_observer_;
};

}  // namespace sslam::cli
