// SPDX-License-Identifier: BSD-3-Clause
// The 7-Scenes layout (Shotton et al., CVPR 2013): frame-NNNNNN.color.png, .depth.png and .pose.txt in one
// folder. The pose is a 4x4 matrix from camera to world; there are no stamps, the recordings ran at 30 frames
// a second.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/datasets/pose_files.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/text.hpp"

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

[[nodiscard]] inline Dataset read_seven_scenes(const std::filesystem::path& root) {
  Dataset dataset;
  dataset.layout = Layout::kSevenScenes;
  dataset.root = root;
  PoseFiles poses(root);
  for (const std::filesystem::path& image : list_files(root, is_seven_scenes_colour)) {
    const std::string stem = seven_scenes_stem(image);
    FrameEntry frame;
    frame.stamp = parse_number<double>(stem.substr(stem.find('-') + 1)).value_or(0) / kSevenScenesFrameRate;
    frame.image = image.string();
    std::error_code ignored;
    if (const auto depth = root / (stem + ".depth.png"); std::filesystem::is_regular_file(depth, ignored)) {
      frame.depth = depth.string();
    }
    poses.attach(dataset, frame, root / (stem + ".pose.txt"));
    dataset.frames.push_back(std::move(frame));
  }
  if (dataset.frames.empty()) throw Error(root.string() + ": holds no frame-NNNNNN.color.png");
  drop_bad_frames(dataset, root);
  poses.settle(dataset);
  return dataset;
}

}  // namespace sslam::io
