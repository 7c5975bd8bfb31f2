// SPDX-License-Identifier: BSD-3-Clause
// Brings a calibration and the images that it is for together, before the first frame: one size, and a camera
// that can be right.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "cli/input/size_text.hpp"
#include "sslam/core/error.hpp"
#include "sslam/geometry/camera_check.hpp"
#include "sslam/geometry/resized_camera.hpp"

namespace sslam::cli {

// Gives `camera` the images' size, or throws Error; `source` is what to name. What the user should know is
// added to `notes` and `warnings`.
inline void fit_camera(Camera<double>& camera, int width, int height, const std::string& source,
                       std::vector<std::string>& notes, std::vector<std::string>& warnings) {
  if (camera.width == 0 || camera.height == 0) {
    camera.width = width;
    camera.height = height;
  }
  // Whether a side is what the other one's ratio makes of it, to the pixel.
  const auto same_shape = [&camera](int w, int h) {
    return std::abs(static_cast<double>(w) * camera.height / camera.width - h) <= 1;
  };
  const std::string given = size_text(camera.width, camera.height), wanted = size_text(width, height);
  if (given != wanted) {
    const std::string both = source + ": is for " + given + " pixels, and the images have " + wanted;
    if (same_shape(width, height)) {
      camera = resized(camera, width, height);
      notes.push_back(both + ": scaled to them");
    } else if (same_shape(height, width)) {
      throw Error(both +
                  ": they are turned by 90 degrees; turn them back, or calibrate the camera as it is held");
    } else {
      throw Error(both + ": another aspect ratio; expected a calibration of images of this size");
    }
  }
  const CameraCheck check = check_camera(camera);
  if (!check.fault.empty()) throw Error(source + ": " + check.fault);
  for (const std::string& doubt : check.doubts) warnings.push_back(source + ": " + doubt);
}

}  // namespace sslam::cli
