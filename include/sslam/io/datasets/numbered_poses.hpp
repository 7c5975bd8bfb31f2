// SPDX-License-Identifier: BSD-3-Clause
// Layouts of numbered images with one file of poses: the odometry benchmark of KITTI (Geiger et al., CVPR
// 2012), and Replica as iMAP and NICE-SLAM rendered it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"

namespace sslam::io {

inline constexpr double kReplicaFrameRate = 30, kKittiFrameRate = 10;

// The image's number: 12 of frame000012.jpg; nothing without digits at the end.
[[nodiscard]] inline std::optional<std::size_t> number_of(const std::filesystem::path& image) {
  const std::string stem = image.stem().string();
  return parse_number<std::size_t>(stem.substr(stem.find_last_not_of("0123456789") + 1));
}

// Of poses that have the numbers of images in place of stamps: says how many images have none.
inline void tell_missing_rows(Dataset& dataset, const std::filesystem::path& poses, std::size_t rows) {
  const auto missing = std::count_if(dataset.frames.begin(), dataset.frames.end(),
                                     [](const FrameEntry& frame) { return frame.truth < 0; });
  if (missing > 0 && !dataset.ground_truth.empty())
    dataset.warnings.push_back(poses.string() + ": its " + std::to_string(rows) + " rows leave " +
                               std::to_string(missing) + " of " + std::to_string(dataset.frames.size()) +
                               " images without ground truth; expected row N for the image numbered N");
}

[[nodiscard]] inline bool is_replica_image(const std::filesystem::path& name) {
  return is_image_name(name) && name.string().starts_with("frame") && number_of(name);
}

[[nodiscard]] inline bool is_replica(const std::filesystem::path& root) {
  return !list_files(root / "results", is_replica_image).empty();
}

[[nodiscard]] inline Dataset read_replica(const std::filesystem::path& root) {
  Dataset dataset;
  dataset.layout = Layout::kReplica;
  dataset.root = root;
  for (const std::filesystem::path& image : list_files(root / "results", is_replica_image)) {
    FrameEntry frame;
    frame.stamp = static_cast<double>(*number_of(image)) / kReplicaFrameRate;
    frame.image = image.string();
    const std::string digits = image.stem().string().substr(std::string_view("frame").size());
    std::error_code ignored;
    if (const auto depth = root / "results" / ("depth" + digits + ".png");
        std::filesystem::is_regular_file(depth, ignored))
      frame.depth = depth.string();
    dataset.frames.push_back(std::move(frame));
  }
  drop_bad_frames(dataset, root / "results");
  // One camera for all of its rooms: it lies beside them.
  const std::filesystem::path folder = std::filesystem::absolute(root / ".").lexically_normal().parent_path();
  std::error_code missing;
  for (const std::filesystem::path& place : {root, folder.parent_path()})
    if (dataset.camera_file.empty() && std::filesystem::is_regular_file(place / "cam_params.json", missing))
      dataset.camera_file = place / "cam_params.json";
  const std::filesystem::path poses = root / "traj.txt";
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(poses, ignored)) return dataset;
  attach_or_leave_out(dataset, [&] {
    PoseFile file = read_pose_file(poses, dataset.warnings);
    for (StampedPose& pose : file.trajectory)
      if (file.counted) pose.stamp /= kReplicaFrameRate;
    const std::size_t rows = file.trajectory.size() + file.no_pose;
    attach_ground_truth(dataset, std::move(file.trajectory), poses);
    if (file.no_pose == 0) tell_missing_rows(dataset, poses, rows);
  });
  return dataset;
}

// The folder of images: the left grey camera's, else the left colour camera's; empty: none.
[[nodiscard]] inline std::filesystem::path find_kitti_images(const std::filesystem::path& root) {
  const auto numbered = [](const std::filesystem::path& name) {
    return is_image_name(name) && all_digits(name.stem().string());
  };
  for (const char* name : {"image_0", "image_2"})
    if (!list_files(root / name, numbered).empty()) return root / name;
  return {};
}

[[nodiscard]] inline bool is_kitti(const std::filesystem::path& root) {
  return !find_kitti_images(root).empty();
}

// The benchmark keeps poses/NN.txt beside sequences/NN.
[[nodiscard]] inline std::filesystem::path find_kitti_poses(const std::filesystem::path& root) {
  std::error_code ignored;
  const std::filesystem::path full = std::filesystem::weakly_canonical(root / ".", ignored);
  const std::filesystem::path folder = full.has_filename() ? full : full.parent_path();
  const std::string name = folder.filename().string() + ".txt";
  for (const std::filesystem::path& file :
       {folder / "poses.txt", folder / "poses" / name, folder.parent_path().parent_path() / "poses" / name})
    if (std::filesystem::is_regular_file(file, ignored)) return file;
  return {};
}

[[nodiscard]] inline Dataset read_kitti(const std::filesystem::path& root) {
  const std::filesystem::path images = find_kitti_images(root), times = root / "times.txt";
  Dataset dataset;
  dataset.layout = Layout::kKitti;
  dataset.root = root;
  std::error_code ignored;
  std::vector<double> clock;
  if (std::filesystem::is_regular_file(times, ignored)) {
    clock = read_times(times, dataset.warnings);
  } else {
    dataset.warnings.push_back(times.string() + ": is missing; images taken as 10 a second");
  }
  for (const std::filesystem::path& image : list_files(images, is_image_name)) {
    const auto number = number_of(image);
    if (!number) continue;
    if (!clock.empty() && *number >= clock.size())
      throw Error(times.string() + ": has " + std::to_string(clock.size()) + " times and none for " +
                  image.filename().string() + "; expected one an image, from 0 on");
    FrameEntry frame;
    frame.stamp = clock.empty() ? static_cast<double>(*number) / kKittiFrameRate : clock[*number];
    frame.image = image.string();
    dataset.frames.push_back(std::move(frame));
  }
  drop_bad_frames(dataset, images);
  if (std::filesystem::is_regular_file(root / "calib.txt", ignored)) dataset.camera_file = root / "calib.txt";
  const std::filesystem::path poses = find_kitti_poses(root);
  if (poses.empty()) return dataset;
  attach_or_leave_out(dataset, [&] {
    PoseFile file = read_pose_file(poses, dataset.warnings, kNoTimes);
    const std::size_t rows = file.trajectory.size() + file.no_pose;
    const auto row_of = [](const StampedPose& pose) { return static_cast<std::size_t>(pose.stamp); };
    if (file.counted && !clock.empty()) {
      std::erase_if(file.trajectory, [&](const StampedPose& pose) { return row_of(pose) >= clock.size(); });
      for (StampedPose& pose : file.trajectory) pose.stamp = clock[row_of(pose)];
    } else if (file.counted) {
      for (StampedPose& pose : file.trajectory) pose.stamp /= kKittiFrameRate;
    }
    attach_ground_truth(dataset, std::move(file.trajectory), poses);
    if (file.no_pose == 0) tell_missing_rows(dataset, poses, rows);
    if (images.filename() != "image_0")
      dataset.warnings.push_back(poses.string() + ": poses of image_0, taken for " +
                                 images.filename().string());
  });
  return dataset;
}

}  // namespace sslam::io
