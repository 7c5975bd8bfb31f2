// SPDX-License-Identifier: BSD-3-Clause
// The files of a run: trajectories, map, per-frame table, metrics, top view.
#pragma once

#include <filesystem>
#include <string>

#include "cli/results/frame_record.hpp"
#include "cli/run.hpp"
#include "sslam/geometry/camera.hpp"
#include "sslam/io/datasets/dataset.hpp"

namespace sslam::cli {

// What the report says about the run besides its outcome.
struct RunContext {
  const RunSettings& settings;
  const io::Dataset& dataset;
  std::string camera_source;
  Camera<double> camera;          // of the images
  Camera<double> working_camera;  // of the images as they are worked on
  double view_fov = 0;  // degrees across that the images of a wide lens were undistorted to, the cameras'
                        // view; 0: they are no such images
};

// Writes all files into a folder, metrics.json with the checksums of the others, and prints the summary.
// Throws Error when a file cannot be written.
void write_run(const RunContext& context, const RunOutcome& outcome, const std::filesystem::path& out);

}  // namespace sslam::cli
