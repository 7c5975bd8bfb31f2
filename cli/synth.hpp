// SPDX-License-Identifier: BSD-3-Clause
// Renders a synthetic house into a folder in the TUM RGB-D layout.
#pragma once

#include <cstdint>
#include <string>

#include "cli/shell/progress.hpp"
#include "cli/synth/camera_error.hpp"
#include "cli/synth/image_fixed.hpp"
#include "sslam/geometry/camera.hpp"
#include "sslam/synth/house.hpp"
#include "sslam/synth/sensor.hpp"

namespace sslam::cli {

struct SynthSettings {
  std::string folder;
  synth::HouseOptions house;
  synth::SensorOptions sensor;
  int frames = 0;      // 0: one lap of the path
  double rate = 30.0;  // frames per second
  int width = 640, height = 480;
  double focal = 0.0;            // pixels; 0: as the next says
  double focal_of_width = 0.75;  // share of the width: a view of 67 degrees
  RadTan<double> lens;           // its distortion
  CameraError camera_error;      // of the camera file
  double blur = 0.0;             // share of the frame time that the shutter is open
  double read_out = 0.0;         // seconds from the first row to the last
  ImageFixed image_fixed = ImageFixed::kNone;
  std::string image_format = "jpg";
  int jpeg_quality = 95;
  bool depth = true, normals = true;
  int threads = 0;  // 0: one for each processor
  Verbosity verbosity = Verbosity::kNormal;
};

struct SynthReport {
  int frames = 0;
  double path_metres = 0.0;
  double build_seconds = 0.0, render_seconds = 0.0;
  bool interrupted = false;
};

// Takes the place of an earlier data set in the folder as a whole, once it is complete; interrupted before
// its first image, it leaves that alone. Throws Error, in one line, when the folder cannot be written or
// holds another data set.
SynthReport synthesise(const SynthSettings& settings);

}  // namespace sslam::cli
