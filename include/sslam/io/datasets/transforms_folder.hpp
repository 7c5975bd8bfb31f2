// SPDX-License-Identifier: BSD-3-Clause
// A folder with a transforms.json that lists its images.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>

#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/datasets/file_list.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/trajectories/transforms.hpp"

namespace sslam::io {

inline constexpr double kTransformsDepthFactor = 1000;  // millimetres

// One that holds a camera alone says nothing about images.
[[nodiscard]] inline bool is_transforms_folder(const std::filesystem::path& root) {
  std::error_code ignored;
  const std::filesystem::path file = root / "transforms.json";
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  const std::string text = read_plain_text(file);
  return is_transforms_text(text) && text.find("\"file_path\"") != std::string::npos;
}

[[nodiscard]] inline Dataset read_transforms_folder(const std::filesystem::path& root, double frame_rate) {
  const std::filesystem::path file = root / "transforms.json";
  Dataset dataset;
  dataset.layout = Layout::kTransforms;
  dataset.root = root;
  dataset.depth_factor = kTransformsDepthFactor;
  Transforms transforms = read_transforms(file, dataset.warnings);
  if (transforms.stamped) to_seconds(transforms.frames, StampsOf::kImages, file, dataset.warnings);
  for (std::size_t i = 0; i < transforms.frames.size(); ++i) {
    const TransformsFrame& named = transforms.frames[i];
    FrameEntry frame;
    frame.stamp = transforms.stamped ? named.stamp : static_cast<double>(i) / frame_rate;
    frame.image = file_list_detail::find_image(root, named.file);
    if (!named.depth.empty()) {
      const std::string depth = file_list_detail::find_listed(root, named.depth);
      if (file_list_detail::is_file(depth)) frame.depth = depth;
    }
    if (named.world_from_cam) {
      frame.truth = static_cast<std::ptrdiff_t>(dataset.ground_truth.size());
      dataset.ground_truth.push_back({frame.stamp, *named.world_from_cam});
    }
    dataset.frames.push_back(std::move(frame));
  }
  if (transforms.no_pose > 0)
    dataset.warnings.push_back(no_pose_note(file, transforms.no_pose, transforms.frames.size()));
  drop_bad_frames(dataset, file);
  try {
    transforms.bad_poses.settle(transforms.frames.size(), dataset.warnings);
  } catch (const Error& error) {
    leave_truth_out(dataset, error.what());
  }
  return dataset;
}

}  // namespace sslam::io
