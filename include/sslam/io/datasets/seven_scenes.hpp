// SPDX-License-Identifier: BSD-3-Clause
// The 7-Scenes layout (Shotton et al., CVPR 2013): frame-NNNNNN.color.png, .depth.png and .pose.txt in one
// folder. The pose is a 4x4 matrix from camera to world; there are no stamps, the recordings ran at 30 frames
// a second.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/io/trajectories/pose_row.hpp"

namespace sslam::io {

inline constexpr double kSevenScenesFrameRate = 30;

// "frame-000012" of "frame-000012.color.png"; empty for any other name.
[[nodiscard]] inline std::string seven_scenes_stem(const std::filesystem::path& name) {
  constexpr std::string_view kPrefix = "frame-";
  const std::string text = name.filename().string();
  const std::size_t digits_end = text.find_first_not_of("0123456789", kPrefix.size());
  if (text.rfind(kPrefix, 0) != 0 || digits_end == std::string::npos || digits_end == kPrefix.size())
    return {};
  if (text.compare(digits_end, std::string::npos, ".color.png") != 0 &&
      text.compare(digits_end, std::string::npos, ".color.jpg") != 0) {
    return {};
  }
  return text.substr(0, digits_end);
}

[[nodiscard]] inline bool is_seven_scenes_colour(const std::filesystem::path& name) {
  return !seven_scenes_stem(name).empty();
}

[[nodiscard]] inline bool is_seven_scenes(const std::filesystem::path& root) {
  return !list_files(root, is_seven_scenes_colour).empty();
}

// Nothing when the file does not hold a rigid motion, with the reason in `why`: empty where the matrix means
// that there is no pose.
[[nodiscard]] inline std::optional<SE3<double>> read_pose_matrix(const std::filesystem::path& path,
                                                                 std::string& why) {
  std::vector<double> v;
  const std::string text = read_plain_text(path);
  for (const TextRow& row : split_rows(text))
    for (const std::string_view cell : row.cells)
      if (const auto number = parse_cell(cell)) v.push_back(*number);
  std::optional<SE3<double>> pose;
  why.clear();
  if (v.size() != 16) {
    why = "expected a 4x4 matrix, found " + std::to_string(v.size()) + " numbers";
  } else if (!means_no_pose(v)) {
    pose = pose_of_matrix(v, why);
  }
  if (!why.empty()) why = path.filename().string() + ": " + why;
  return pose;
}

[[nodiscard]] inline Dataset read_seven_scenes(const std::filesystem::path& root) {
  Dataset dataset;
  dataset.layout = Layout::kSevenScenes;
  dataset.root = root;
  BadEntries bad_poses(root);
  std::size_t poses = 0, no_pose = 0;
  for (const std::filesystem::path& image : list_files(root, is_seven_scenes_colour)) {
    const std::string stem = seven_scenes_stem(image);
    FrameEntry frame;
    frame.stamp = parse_number<double>(stem.substr(stem.find('-') + 1)).value_or(0) / kSevenScenesFrameRate;
    frame.image = image.string();
    std::error_code ignored;
    if (const auto depth = root / (stem + ".depth.png"); std::filesystem::is_regular_file(depth, ignored)) {
      frame.depth = depth.string();
    }
    if (const auto pose = root / (stem + ".pose.txt"); std::filesystem::is_regular_file(pose, ignored)) {
      ++poses;
      std::string why;
      if (const auto world_from_cam = read_pose_matrix(pose, why)) {
        frame.truth = static_cast<std::ptrdiff_t>(dataset.ground_truth.size());
        dataset.ground_truth.push_back({frame.stamp, *world_from_cam});
      } else if (why.empty()) {
        ++no_pose;
      } else {
        bad_poses.add(why);
      }
    }
    dataset.frames.push_back(std::move(frame));
  }
  if (dataset.frames.empty()) throw Error(root.string() + ": holds no frame-NNNNNN.color.png");
  drop_bad_frames(dataset, root);
  if (no_pose > 0) dataset.warnings.push_back(no_pose_note(root, no_pose, poses));
  try {
    bad_poses.settle(poses - no_pose, dataset.warnings);
    if (poses > 0 && poses == no_pose) leave_truth_out(dataset, root.string() + ": none of its poses is one");
  } catch (const Error& error) {
    leave_truth_out(dataset, error.what());
  }
  return dataset;
}

}  // namespace sslam::io
