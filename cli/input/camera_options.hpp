// SPDX-License-Identifier: BSD-3-Clause
// The options that say which camera took the images.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/shell/number_checks.hpp"
#include "sslam/io/datasets/known_cameras.hpp"
#include "sslam/opencv/camera/wide_view.hpp"

namespace sslam::cli {

inline void add_camera_options(CLI::App& command, std::string& file, double& focal, double& fov) {
  CLI::Option* const camera =
      command
          .add_option(
              "--camera", file,
              "Camera file (ORB-SLAM, OpenCV, ROS, Kalibr, EuRoC, COLMAP, ...) or built-in calibration: " +
                  io::known_camera_names())
          ->type_name("FILE");
  CLI::Option* const pixels =
      command
          .add_option("--focal", focal,
                      "Focal length in pixels, for a camera without a calibration; no distortion")
          ->check(finite_number())
          ->check(CLI::PositiveNumber)
          ->type_name("PIXELS")
          ->excludes(camera);
  command.add_option("--fov", fov, "Horizontal field of view, in place of --focal")
      ->check(finite_number())
      ->check(CLI::Range(3.0, 150.0))
      ->type_name("DEGREES")
      ->excludes(camera)
      ->excludes(pixels);
}

inline void add_undistort_option(CLI::App& command, double& fov) {
  command
      .add_option("--undistort-fov", fov,
                  "Horizontal angle of the pinhole view that images of a wide lens are undistorted to; "
                  "default 110, or less if the lens sees less")
      ->check(finite_number())
      ->check(CLI::Range(30.0, WideView::kWidest))
      ->type_name("DEGREES");
}

}  // namespace sslam::cli
