// SPDX-License-Identifier: BSD-3-Clause
// By how much a camera file is off from the camera that took the images, and the numbers of a lens, as the
// command line spells them.
#pragma once

#include <array>
#include <string>
#include <utility>

#include "sslam/geometry/camera.hpp"

namespace sslam::cli {

struct CameraError {
  double focal = 0;                       // share of the focal length
  double cx = 0, cy = 0;                  // pixels
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0;  // added to the lens's
};

inline constexpr std::array<std::pair<const char*, double CameraError::*>, 7> kCameraErrorNames{
    {{"focal", &CameraError::focal},
     {"cx", &CameraError::cx},
     {"cy", &CameraError::cy},
     {"k1", &CameraError::k1},
     {"k2", &CameraError::k2},
     {"p1", &CameraError::p1},
     {"p2", &CameraError::p2}}};

// "focal=0.05,k1=0.1". Returns what is wrong with the text, empty for nothing.
[[nodiscard]] std::string parse_camera_error(const std::string& text, CameraError& error);
// As it is parsed again; empty for no error.
[[nodiscard]] std::string camera_error_text(const CameraError& error);
// The camera as a file that is off by the error has it.
[[nodiscard]] Camera<double> with_error(Camera<double> camera, const CameraError& error);

// "k1,k2" or "k1,k2,p1,p2". Returns what is wrong with the text, empty for nothing.
[[nodiscard]] std::string parse_lens(const std::string& text, RadTan<double>& lens);
[[nodiscard]] std::string lens_text(const RadTan<double>& lens);

}  // namespace sslam::cli
