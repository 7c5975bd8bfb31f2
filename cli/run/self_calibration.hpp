// SPDX-License-Identifier: BSD-3-Clause
// The camera as a part of what a run finds out: whether the map agrees with the calibration, and which one it
// asks for where it does not.
#pragma once

#include <string>

#include "cli/input/mask_source.hpp"
#include "cli/run.hpp"
#include "sslam/ceres/camera_estimate.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/system/system.hpp"

namespace sslam::cli {

// What a map says of the camera that it was made with.
struct CameraFinding {
  Camera<double> camera;    // of the images: the given one, changed by the estimate
  CameraEstimate estimate;  // of the images as they are worked on
  CameraVerdict verdict = CameraVerdict::kOpen;
};

// min_gain: see CameraVerdictOptions.
[[nodiscard]] CameraFinding examine_camera(const System& system, const CameraPrior& prior,
                                           double min_gain = CameraVerdictOptions().min_gain);

// Tracks the first part of the dataset with `settings` until the map says something about the camera, again
// and again with the camera that was found, until it agrees with itself. Lines alone give the rotation, and
// nobody looks on. kOpen: nothing was found, and the given camera stands in the answer.
[[nodiscard]] CameraFinding find_camera(const io::Dataset& dataset, const Settings& settings,
                                        const MaskSource& masks, const CameraPrior& prior);

// "focal length 481.2 px, centre (319.5, 239.9), k1 0.012, k2 -0.003"
[[nodiscard]] std::string camera_text(const Camera<double>& camera);

}  // namespace sslam::cli
