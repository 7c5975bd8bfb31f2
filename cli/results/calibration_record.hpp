// SPDX-License-Identifier: BSD-3-Clause
// What a run says about its camera, for the terminal and metrics.json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sslam/ceres/camera_estimate.hpp"

namespace sslam::cli {

// What a map says of the camera that it was made with.
struct CameraFinding {
  Camera<double> camera;    // of the images: the given one, changed by the estimate
  CameraEstimate estimate;  // of the images as they are worked on
  CameraVerdict verdict = CameraVerdict::kOpen;
};

struct CalibrationRecord {
  Camera<double> given;                     // before the run
  double depth_factor = 0, frame_rate = 0;  // as CameraFile has them
  CameraFinding last;                       // by the map that is written
  bool replaced = false;  // the run was tracked with a camera that was found, and not with the given one
};

// "focal length 481.2 pixels, centre (319.5, 239.9), k1 0.012, k2 -0.003"
[[nodiscard]] std::string camera_text(const Camera<double>& camera);

[[nodiscard]] nlohmann::ordered_json calibration_json(const CalibrationRecord& record);

}  // namespace sslam::cli
