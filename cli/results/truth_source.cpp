// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/truth_source.hpp"

#include <optional>
#include <utility>

#include "cli/input/open_images.hpp"
#include "cli/results/run_folder.hpp"
#include "sslam/io/datasets/icl_nuim.hpp"
#include "sslam/io/datasets/tum.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"

namespace sslam::cli {
namespace {

TruthSource from_folder(const std::filesystem::path& folder, FileAxes axes) {
  io::Dataset dataset = open_frames(folder);
  if (!dataset.truth_problem.empty()) throw Error(dataset.truth_problem);
  if (dataset.ground_truth.empty()) throw Error(folder.string() + ": this dataset has no ground truth");
  TruthSource source;
  source.trajectory = std::move(dataset.ground_truth);
  source.seconds_per_stamp = dataset.seconds_per_stamp;
  source.frame_stamps = io::frame_stamps(dataset);
  source.warnings = std::move(dataset.warnings);
  // The reader has turned ICL-NUIM's poses already.
  const bool turned = dataset.layout == io::Layout::kIclNuim;
  const bool wanted = axes == FileAxes::kAuto ? turned : axes == FileAxes::kYUp;
  if (wanted != turned) io::mirror_y(source.trajectory);
  source.mirrored = wanted;
  return source;
}

// The dataset whose ground truth the file is; nothing for a file that stands alone.
std::optional<io::Dataset> dataset_around(const std::filesystem::path& file) {
  const std::filesystem::path folder = folder_of(file);
  if (file.filename() != "groundtruth.txt" && file.extension() != ".freiburg") return std::nullopt;
  if (!io::is_tum(folder) && !io::has_numbered_images(folder)) return std::nullopt;
  try {
    return dataset_at(folder);
  } catch (const Error&) {
    return std::nullopt;  // a copy without its images still has a ground truth
  }
}

// A run keeps its ground truth; what it leaves looks like no dataset.
bool is_run_folder(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::exists(folder / "metrics.json", ignored);
}

}  // namespace

TruthSource load_truth(const std::filesystem::path& path, FileAxes axes, const std::filesystem::path& times) {
  std::error_code ignored;
  if (is_run_folder(path) && std::filesystem::exists(path / kTruthFile, ignored))
    return load_truth(path / kTruthFile, axes);
  if (std::filesystem::is_directory(path, ignored) || io::is_bag_name(path)) return from_folder(path, axes);
  TruthSource source;
  io::PoseFile file = io::read_pose_file(path, source.warnings, times);
  source.trajectory = std::move(file.trajectory);
  source.counted = file.counted;
  const std::optional<io::Dataset> dataset = dataset_around(path);
  const bool icl_nuim =
      path.extension() == ".freiburg" || (dataset && dataset->layout == io::Layout::kIclNuim);
  if (dataset) source.frame_stamps = io::frame_stamps(*dataset);
  if (icl_nuim) source.seconds_per_stamp = 1 / io::kIclNuimFrameRate;
  source.mirrored = axes == FileAxes::kAuto ? icl_nuim : axes == FileAxes::kYUp;
  if (source.mirrored) io::mirror_y(source.trajectory);
  return source;
}

io::Trajectory load_stamped(const std::filesystem::path& path, io::Warnings& warnings) {
  return io::read_trajectory(path, warnings);
}

io::PoseFile load_estimate(const std::filesystem::path& path, io::Warnings& warnings,
                           const std::filesystem::path& times) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) return io::read_pose_file(path, warnings, times);
  if (std::filesystem::exists(path / "trajectory.txt", ignored))
    return io::read_pose_file(path / "trajectory.txt", warnings, times);
  throw Error(path.string() + ": holds no trajectory.txt; expected a trajectory, or the folder of a run");
}

io::Trajectory truth_during(const io::Dataset& dataset, const io::Trajectory& truth) {
  io::Trajectory seen;
  for (const io::StampedPose& pose : truth)
    if (pose.stamp >= dataset.frames.front().stamp - io::kMaxStampDifference &&
        pose.stamp <= dataset.frames.back().stamp + io::kMaxStampDifference)
      seen.push_back(pose);
  return seen;
}

}  // namespace sslam::cli
