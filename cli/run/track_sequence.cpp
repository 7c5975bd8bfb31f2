// SPDX-License-Identifier: BSD-3-Clause
#include "cli/run/track_sequence.hpp"

#include "cli/results/map_figures.hpp"
#include "cli/shell/interrupt.hpp"
#include "sslam/system/wall_timer.hpp"

namespace sslam::cli {

void track_sequence(System& system, FrameStream& stream, RunRecorder& recorder, std::size_t known_keyframes,
                    const std::function<void()>& passed) {
  RunOutcome& outcome = recorder.outcome;
  outcome.parameters = system.parameters().entries();
  const double before = outcome.wall_seconds;
  WallTimer wall;
  wall.begin();
  ExtractedFrame input;
  while (!Interrupt::asked() && stream.next(input)) {
    if (!input.warning.empty()) system.warn(input.warning);
    if (input.usable()) {
      (void)system.track(input);
      if (const std::string fault = stream.fault_of_normals(input); !fault.empty()) system.warn(fault);
    }
    ++outcome.frames_taken;
    outcome.frames_dropped = stream.dropped();
    outcome.wall_seconds = before + wall.total() * 1e-3;
    passed();
  }
  if (Interrupt::asked()) passed();
  stream.stop();  // a camera need not go on while the last frames are worked on
  WallTimer last;
  last.begin();
  if (system.finish() && !outcome.frames.empty()) outcome.frames.back().loop_closed = true;
  outcome.final_pass_seconds = last.total() * 1e-3;
  outcome.wall_seconds = before + wall.total() * 1e-3;
  outcome.interrupted = Interrupt::asked();
  outcome.map = system.map();
  outcome.colours = recorder.colours.of(outcome.map);
  outcome.world = system.world();
  outcome.apart = system.apart();
  outcome.read_out = system.read_out();
  outcome.keyframes_not_made = system.keyframes_not_made();
  outcome.keyframes = keyframe_poses(system.map(), known_keyframes);
  outcome.trajectory = system.trajectory();
}

}  // namespace sslam::cli
