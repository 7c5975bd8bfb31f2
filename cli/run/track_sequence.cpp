// SPDX-License-Identifier: BSD-3-Clause
#include "cli/run/track_sequence.hpp"

#include <algorithm>
#include <ctime>
#include <vector>

#include "cli/results/map_figures.hpp"
#include "cli/shell/interrupt.hpp"
#include "sslam/system/wall_timer.hpp"

namespace sslam::cli {
namespace {

// How long a run has been going on, on the clock and on the processors, those included before it was resumed.
class RunClock {
 public:
  explicit RunClock(const RunOutcome& outcome)
      : wall_before_(outcome.wall_seconds), processor_before_(outcome.processor_seconds - processor()) {
    wall_.begin();
  }
  void note(RunOutcome& outcome) const {
    outcome.wall_seconds = wall_before_ + wall_.total() * 1e-3;
    outcome.processor_seconds = processor_before_ + processor();
  }

 private:
  [[nodiscard]] static double processor() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

  WallTimer wall_;
  double wall_before_, processor_before_;
};

}  // namespace

void track_sequence(System& system, FrameStream& stream, RunRecorder& recorder, std::size_t known_keyframes,
                    const std::function<void()>& passed) {
  RunOutcome& outcome = recorder.outcome;
  outcome.parameters = system.parameters().entries();
  const RunClock clock(outcome);
  ExtractedFrame input;
  while (!Interrupt::asked() && stream.next(input)) {
    if (!input.warning.empty()) system.warn(input.warning);
    if (input.usable()) {
      (void)system.track(input);
      if (const std::string fault = stream.fault_of_normals(input); !fault.empty()) system.warn(fault);
    }
    ++outcome.frames_taken;
    outcome.frames_dropped = stream.dropped();
    clock.note(outcome);
    passed();
  }
  if (Interrupt::asked()) passed();
  stream.stop();  // a camera need not go on while the last frames are worked on
  WallTimer last;
  last.begin();
  if (system.finish() && !outcome.frames.empty()) outcome.frames.back().loop_closed = true;
  outcome.final_pass_seconds = last.total() * 1e-3;
  clock.note(outcome);
  outcome.interrupted = Interrupt::asked();
  outcome.map = system.map();
  outcome.colours = recorder.colours.of(outcome.map);
  outcome.world = system.world();
  outcome.apart = system.apart();
  outcome.read_out = system.read_out();
  outcome.keyframes_not_made = system.keyframes_not_made();
  outcome.keyframes = keyframe_poses(system.map(), known_keyframes);
  outcome.trajectory = system.trajectory();
  const std::vector<double> bridged = system.bridged();
  for (FrameRecord& frame : outcome.frames)
    frame.bridged = std::binary_search(bridged.begin(), bridged.end(), frame.stamp);
}

}  // namespace sslam::cli
