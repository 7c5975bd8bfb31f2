// SPDX-License-Identifier: BSD-3-Clause
// Folders of colour and depth images side by side, as RealSense's and Open3D's recorders leave them, and
// ScanNet (Dai et al., CVPR 2017), which has pose/ and intrinsic/ too.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/image_folder.hpp"
#include "sslam/io/datasets/pose_files.hpp"
#include "sslam/io/files/files.hpp"

namespace sslam::io {

// Empty: none.
[[nodiscard]] inline std::filesystem::path find_colour_folder(const std::filesystem::path& root) {
  for (const char* name : {"color", "colour", "rgb", "image", "images"})
    if (is_image_folder(root / name)) return root / name;
  return {};
}

[[nodiscard]] inline bool is_colour_depth(const std::filesystem::path& root) {
  return !find_colour_folder(root).empty() && is_image_folder(root / "depth");
}

[[nodiscard]] inline bool is_scannet(const std::filesystem::path& root) {
  std::error_code ignored;
  return is_image_folder(root / "color") && std::filesystem::is_directory(root / "pose", ignored) &&
         std::filesystem::is_directory(root / "intrinsic", ignored);
}

// Depth images of the same names, or with stamps for names the nearest in time.
inline void attach_depth_folder(Dataset& dataset, const std::filesystem::path& folder) {
  const std::vector<std::filesystem::path> depths = list_files(folder, is_image_name);
  std::size_t found = 0;
  for (FrameEntry& frame : dataset.frames) {
    const std::filesystem::path same = folder / std::filesystem::path(frame.image).stem().concat(".png");
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(same, ignored)) continue;
    frame.depth = same.string();
    ++found;
  }
  if (const auto named = stamps_of_names(depths); found == 0 && named) {
    for (const StampPair& pair : associate(frame_stamps(dataset), named->seconds, kMaxStampDifference)) {
      dataset.frames[pair.a].depth = depths[pair.b].string();
      ++found;
    }
  }
  if (found == 0 && !depths.empty())
    dataset.warnings.push_back(folder.string() +
                               ": none of its images has the name or the time of a colour "
                               "image: depth left out");
}

[[nodiscard]] inline Dataset read_colour_depth(const std::filesystem::path& root, double frame_rate) {
  constexpr double kMillimetres = 1000;
  Dataset dataset = read_image_folder(find_colour_folder(root), frame_rate);
  dataset.layout = Layout::kColourDepth;
  dataset.root = root;
  dataset.depth_factor = kMillimetres;
  attach_depth_folder(dataset, root / "depth");
  std::error_code ignored;
  for (const char* name : {"camera_intrinsic.json", "intrinsic.json", "camera_intrinsics.json"})
    if (std::filesystem::is_regular_file(root / name, ignored)) {
      dataset.camera_file = root / name;
      break;
    }
  return dataset;
}

// Its depth images have a size and a camera of their own, and depth is taken registered to colour alone.
[[nodiscard]] inline Dataset read_scannet(const std::filesystem::path& root, double frame_rate) {
  Dataset dataset = read_image_folder(root / "color", frame_rate);
  dataset.layout = Layout::kScanNet;
  dataset.root = root;
  if (is_image_folder(root / "depth"))
    dataset.warnings.push_back((root / "depth").string() +
                               ": has a camera of its own in ScanNet: depth left out");
  PoseFiles poses(root / "pose");
  for (FrameEntry& frame : dataset.frames)
    poses.attach(dataset, frame, root / "pose" / std::filesystem::path(frame.image).stem().concat(".txt"));
  poses.settle(dataset);
  std::error_code ignored;
  if (const auto camera = root / "intrinsic/intrinsic_color.txt";
      std::filesystem::is_regular_file(camera, ignored))
    dataset.camera_file = camera;
  return dataset;
}

}  // namespace sslam::io
