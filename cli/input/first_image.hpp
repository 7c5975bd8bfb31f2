// SPDX-License-Identifier: BSD-3-Clause
// Whether images and calibration belong together, before the first frame is tracked.
#pragma once

#include "cli/input/camera_choice.hpp"
#include "sslam/io/datasets/dataset.hpp"

namespace sslam::cli {

// By the first image that can be read: fills in the camera's size where its source leaves it out, and tells
// when images are turned or stretched on their way in. Throws Error when the sizes differ.
void fit_camera_to_images(CameraChoice& choice, const io::Dataset& dataset);

}  // namespace sslam::cli
