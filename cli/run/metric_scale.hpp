// SPDX-License-Identifier: BSD-3-Clause
// Metres for a map that has a unit of its own: from depth images, from the camera's height above the floor,
// or from a distance that is known.
#pragma once

#include "cli/results/frame_record.hpp"
#include "cli/results/scale_record.hpp"
#include "cli/run/scale_wish.hpp"
#include "sslam/geometry/camera.hpp"
#include "sslam/io/datasets/dataset.hpp"

namespace sslam::cli {

// Whether the dataset has what is asked for, before anything is tracked. Throws Error.
void check_scale(const ScaleWish& wish, const io::Dataset& dataset, double depth_factor);

struct ScaleInput {
  const io::Dataset& dataset;
  const Camera<double>& working_camera;  // of the images as they are worked on
  double depth_factor = 0;               // value of a metre in 16 bit depth images
  bool metric_map = false;               // the map that the run went on in was in metres
};

// Brings poses and map to metres, where it is asked for and the outcome can tell. `outcome.scale` says how;
// where it cannot, there is a warning, and all stays in the map's own unit.
void bring_to_metres(const ScaleWish& wish, const ScaleInput& input, RunOutcome& outcome);

}  // namespace sslam::cli
