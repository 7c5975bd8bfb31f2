// SPDX-License-Identifier: BSD-3-Clause
// Writes the checkpoints of a run while it goes on.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "cli/results/run_folder.hpp"
#include "cli/run/checkpoint.hpp"
#include "cli/run/checkpoint_clock.hpp"
#include "cli/run/run_recorder.hpp"
#include "cli/shell/messages.hpp"

namespace sslam::cli {

class CheckpointKeeper {
 public:
  // head: what is known before the first frame.
  CheckpointKeeper(std::filesystem::path folder, CheckpointClock clock, CheckpointHead head)
      : folder_(std::move(folder)), clock_(clock), head_(std::move(head)) {}

  // A frame has been passed. `now`: do not wait until it is time. The answer is whether one was written. A
  // folder that takes none costs the run no more than a warning.
  bool keep(const System& system, RunRecorder& recorder, bool now) {
    RunOutcome& outcome = recorder.outcome;
    if (!clock_.wanted() || outcome.frames_taken == 0 || !(now || clock_.is_due())) return false;
    head_.next = outcome.frames_taken;
    head_.last_world = system.last_number();
    clock_.begin();
    ++outcome.checkpoints;
    try {
      write_checkpoint(folder_, head_, outcome, recorder.colours, system.worlds());
    } catch (const Error& error) {
      --outcome.checkpoints;
      clock_.give_up();
      outcome.checkpoint_problem = error.what();
      recorder.warning(outcome.checkpoint_problem + "; the run goes on without checkpoints");
      return false;
    }
    outcome.checkpoint_seconds += clock_.end();
    return true;
  }

 private:
  std::filesystem::path folder_;
  CheckpointClock clock_;
  CheckpointHead head_;
};

}  // namespace sslam::cli
