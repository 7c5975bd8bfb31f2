// SPDX-License-Identifier: BSD-3-Clause
// The camera of a dataset's images, settled by the first of them before any frame is tracked.
#pragma once

#include "cli/input/camera_choice.hpp"
#include "sslam/io/datasets/dataset.hpp"

namespace sslam::cli {

// By the first image that can be read: turns a calibration's size into the images', or makes one up for
// images that nobody has calibrated. Tells what is turned, scaled or assumed. Throws Error when the camera
// cannot be theirs.
[[nodiscard]] CameraChoice camera_for_images(const CameraWish& wish, const io::Dataset& dataset);

}  // namespace sslam::cli
