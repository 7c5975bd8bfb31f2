// SPDX-License-Identifier: BSD-3-Clause
// The camera as a part of what a run finds out: whether the map agrees with the calibration, and which one it
// asks for where it does not.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/input/camera_choice.hpp"
#include "cli/input/mask_source.hpp"
#include "cli/results/calibration_record.hpp"
#include "cli/run/checkpoint.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/system/system.hpp"

namespace sslam::cli {

// What a run does about its camera, step by step.
class SelfCalibration {
 public:
  // guess: whatever stands in `camera`, it is looked for before the run. Dataset and masks outlive this.
  SelfCalibration(io::Dataset& dataset, const MaskSource& masks, const CameraChoice& camera, bool guess);

  // The camera is one that was found.
  [[nodiscard]] bool replaced() const noexcept { return record_.replaced; }
  // Nobody has calibrated this camera.
  [[nodiscard]] bool is_guess() const noexcept { return guess_; }
  // Puts the camera that is found into `camera`, and says so: it will stand in the file `where`.
  void find(Settings settings, CameraChoice& camera, const std::string& where);
  // What another process needs to go on from here, and how it does.
  void keep(const CameraChoice& camera, CheckpointHead& head) const;
  void go_on(const CheckpointHead& head, CameraChoice& camera);
  // What the map says that has been made.
  void examine(const System& system);
  [[nodiscard]] bool contradicts() const noexcept { return record_.last.verdict == CameraVerdict::kDiffers; }
  // With the camera that was found as many frames have a pose as this, and with the given one as that. Where
  // it is far less, the given one is the record's again, and a warning says so.
  [[nodiscard]] bool refuted(std::size_t with_given, std::size_t with_found);
  // For who cannot track again.
  [[nodiscard]] std::string advice(const std::string& where) const;

  [[nodiscard]] const CalibrationRecord& record() const noexcept { return record_; }
  [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

 private:
  io::Dataset& dataset_;
  const MaskSource& masks_;
  CameraPrior prior_;
  bool guess_;
  std::string source_;
  CalibrationRecord record_;
  std::vector<std::string> warnings_;
};

}  // namespace sslam::cli
