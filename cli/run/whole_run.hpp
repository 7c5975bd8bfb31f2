// SPDX-License-Identifier: BSD-3-Clause
// One `sslam run`, from its settings to its files, in three steps.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/foxglove/live_stream.hpp"
#include "cli/results/folder_lock.hpp"
#include "cli/run.hpp"
#include "cli/run/checkpoint.hpp"
#include "cli/run/checkpoint_clock.hpp"
#include "cli/run/metric_scale.hpp"
#include "cli/run/run_input.hpp"
#include "cli/run/run_pass.hpp"
#include "cli/run/self_calibration.hpp"
#include "cli/shell/interrupt.hpp"
#include "cli/stream/recording.hpp"

namespace sslam::cli {

class WholeRun {
 public:
  explicit WholeRun(RunSettings settings) : settings_(std::move(settings)) {}

  // Everything that can be refused is refused here, before the first frame.
  void open();
  // All frames, a second time where the camera turns out to be another one; and what follows the last.
  void track();
  // The results, and what is to be said. Throws Stop where the run was interrupted, or nothing was tracked.
  void write();

 private:
  void choose_normals_source(const Preset& preset);
  void open_output();
  [[nodiscard]] Settings system_settings() const;
  void begin_pass();
  void track_again();
  void examine_camera();
  void follow_up();

  // A second pass through the images is possible.
  [[nodiscard]] bool repeats() const;
  // Whether the map is asked about the camera.
  [[nodiscard]] bool examines() const;
  // What a warning of a camera ends with: where to read the one that was found.
  [[nodiscard]] std::string found_at() const;
  [[nodiscard]] RunOutcome& outcome() { return pass_->recorder.outcome; }

  RunSettings settings_;
  std::vector<ParameterValue> parameters_;
  ScaleWish scale_;
  Map<double> known_;  // that the run goes on in
  bool goes_on_ = false;
  std::optional<Recording> recording_;
  std::optional<Interrupt> interrupt_;  // until all is written
  RunInput input_;
  Settings wanted_;  // of the pass that is to begin
  CheckpointHead head_;
  CheckpointClock checkpoints_{0, 0};
  std::optional<FolderLock> lock_;
  std::optional<SelfCalibration> calibration_;
  std::optional<LiveStream> stream_;
  std::unique_ptr<RunPass> pass_;
};

}  // namespace sslam::cli
