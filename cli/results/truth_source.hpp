// SPDX-License-Identifier: BSD-3-Clause
// A ground truth as the user names it: a trajectory file or a dataset folder, turned to our axes.
#pragma once

#include <filesystem>
#include <vector>

#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::cli {

enum class FileAxes { kAuto, kYDown, kYUp };

struct TruthSource {
  io::Trajectory trajectory;         // y down
  double seconds_per_stamp = 1;      // ICL-NUIM stamps count frames
  std::vector<double> frame_stamps;  // of the images of the dataset around it; empty: not known
  bool mirrored = false;             // the file had y up
  io::Warnings warnings;
};

// With kAuto, a file is taken as y up when it is named like ICL-NUIM's (*.freiburg) or is the ground truth of
// a folder in the layout of ICL-NUIM. Throws Error when there is no ground truth.
[[nodiscard]] TruthSource load_truth(const std::filesystem::path& path, FileAxes axes);

// That part of the truth that was recorded while the frames of the dataset were.
[[nodiscard]] io::Trajectory truth_during(const io::Dataset& dataset, const io::Trajectory& truth);

}  // namespace sslam::cli
