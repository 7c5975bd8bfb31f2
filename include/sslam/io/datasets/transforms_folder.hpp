// SPDX-License-Identifier: BSD-3-Clause
// A folder with a transforms.json that lists its images, or with transforms_train.json and its like.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/datasets/file_list.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/trajectories/transforms.hpp"

namespace sslam::io {

inline constexpr double kTransformsDepthFactor = 1000;  // millimetres

// The files that list its images: transforms.json, else the parts of a set that is split for training. One
// that holds a camera alone says nothing about images.
[[nodiscard]] inline std::vector<std::filesystem::path> find_transforms(const std::filesystem::path& root) {
  std::vector<std::filesystem::path> files;
  for (const char* name :
       {"transforms.json", "transforms_train.json", "transforms_val.json", "transforms_test.json"}) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(root / name, ignored)) continue;
    const std::string text = read_plain_text(root / name);
    if (!is_transforms_text(text) || text.find("\"file_path\"") == std::string::npos) continue;
    files.push_back(root / name);
    if (files.front().filename() == "transforms.json") break;
  }
  return files;
}

[[nodiscard]] inline bool is_transforms_folder(const std::filesystem::path& root) {
  return !find_transforms(root).empty();
}

// All frames of all files.
[[nodiscard]] inline Transforms read_all_transforms(const std::vector<std::filesystem::path>& files,
                                                    Warnings& warnings) {
  Transforms all = read_transforms(files.front(), warnings);
  if (files.size() == 1) return all;
  std::string names = files.front().filename().string(), counts = std::to_string(all.frames.size());
  for (std::size_t i = 1; i < files.size(); ++i) {
    Transforms part = read_transforms(files[i], warnings);
    add_to_list(names, files[i].filename().string());
    add_to_list(counts, std::to_string(part.frames.size()));
    try {
      part.bad_poses.settle(part.frames.size(), warnings);
    } catch (const Error& error) {
      for (TransformsFrame& frame : part.frames) frame.world_from_cam.reset();
      warnings.push_back(std::string(error.what()) + "; its poses are left out");
    }
    all.no_pose += part.no_pose;
    all.frames.insert(all.frames.end(), part.frames.begin(), part.frames.end());
  }
  order_transforms(all);
  warnings.push_back(files.front().parent_path().string() + ": " + names + " list " + counts +
                     " images: taken as one sequence, by " +
                     (all.stamped ? "their timestamps" : "the natural order of their names"));
  return all;
}

[[nodiscard]] inline Dataset read_transforms_folder(const std::filesystem::path& root, double frame_rate) {
  const std::vector<std::filesystem::path> files = find_transforms(root);
  const std::filesystem::path& file = files.front();
  Dataset dataset;
  dataset.layout = Layout::kTransforms;
  dataset.root = root;
  dataset.depth_factor = kTransformsDepthFactor;
  dataset.camera_file = file;
  Transforms transforms = read_all_transforms(files, dataset.warnings);
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
  attach_or_leave_out(dataset,
                      [&] { transforms.bad_poses.settle(transforms.frames.size(), dataset.warnings); });
  return dataset;
}

}  // namespace sslam::io
