// SPDX-License-Identifier: BSD-3-Clause
// ICL-NUIM as published (Handa et al., ICRA 2014): rgb/N.png, depth/N.png, and poses with the frame number as
// stamp in a frame with y up, which are mirrored here into our axes.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sslam/io/dataset.hpp"
#include "sslam/io/files.hpp"
#include "sslam/io/text.hpp"

namespace sslam::io {

// The trajectories were rendered at 30 frames a second.
inline constexpr double kIclNuimFrameRate = 30;

[[nodiscard]] inline bool is_numbered_image(const std::filesystem::path& name) {
  return is_image_name(name) && all_digits(name.stem().string());
}

[[nodiscard]] inline bool is_icl_nuim(const std::filesystem::path& root) {
  return !list_files(root / "rgb", is_numbered_image).empty();
}

// groundtruth.txt, or the published name (livingRoom0.gt.freiburg, traj0.gt.freiburg); empty: none.
[[nodiscard]] inline std::filesystem::path find_icl_nuim_truth(const std::filesystem::path& root) {
  std::error_code ignored;
  if (std::filesystem::exists(root / "groundtruth.txt", ignored)) return root / "groundtruth.txt";
  const auto published = list_files(root, [](const auto& name) { return name.extension() == ".freiburg"; });
  return published.empty() ? std::filesystem::path{} : published.front();
}

[[nodiscard]] inline Dataset read_icl_nuim(const std::filesystem::path& root) {
  Dataset dataset;
  dataset.layout = Layout::kIclNuim;
  dataset.root = root;
  dataset.seconds_per_stamp = 1 / kIclNuimFrameRate;
  for (const std::filesystem::path& image : list_files(root / "rgb", is_numbered_image)) {
    FrameEntry frame;
    frame.stamp = parse_number<double>(image.stem().string()).value_or(0);
    frame.image = image.string();
    const std::filesystem::path depth = root / "depth" / (image.stem().string() + ".png");
    std::error_code ignored;
    if (std::filesystem::is_regular_file(depth, ignored)) frame.depth = depth.string();
    dataset.frames.push_back(std::move(frame));
  }
  if (dataset.frames.empty())
    throw Error((root / "rgb").string() + ": holds no numbered image such as 1.png");
  drop_bad_frames(dataset, root / "rgb");
  if (const std::filesystem::path truth_file = find_icl_nuim_truth(root); !truth_file.empty()) {
    Trajectory truth = read_trajectory(truth_file, dataset.warnings);
    mirror_y(truth);
    attach_ground_truth(dataset, std::move(truth), truth_file);
  }
  return dataset;
}

}  // namespace sslam::io
