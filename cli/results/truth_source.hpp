// SPDX-License-Identifier: BSD-3-Clause
// Trajectories as the user names them: a ground truth is a file, or the folder of a dataset or a run, turned
// to our axes; an estimate is a file or the folder of a run.
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
  bool counted = false;              // the file has no stamps: they are the numbers of its rows
  io::Warnings warnings;
};

// With kAuto, a file is taken as y up when it is named like ICL-NUIM's (*.freiburg) or is the ground truth of
// a folder in the layout of ICL-NUIM. `times`: of a file without stamps; empty: looked for beside it. Throws
// Error when there is no ground truth.
[[nodiscard]] TruthSource load_truth(const std::filesystem::path& path, FileAxes axes,
                                     const std::filesystem::path& times = {});

// io::read_trajectory: poses whose stamps are known. Throws Error, also where they are not.
[[nodiscard]] io::Trajectory load_stamped(const std::filesystem::path& path, io::Warnings& warnings);

// As read_pose_file, also for the folder of a run.
[[nodiscard]] io::PoseFile load_estimate(const std::filesystem::path& path, io::Warnings& warnings,
                                         const std::filesystem::path& times = {});

// That part of the truth that was recorded while the frames of the dataset were.
[[nodiscard]] io::Trajectory truth_during(const io::Dataset& dataset, const io::Trajectory& truth);

}  // namespace sslam::cli
