// SPDX-License-Identifier: BSD-3-Clause
// ICL-NUIM as published (Handa et al., ICRA 2014): rgb/N.png, depth/N.png, and poses with the frame number as
// stamp in a frame with y up, which are mirrored here into our axes.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sslam/io/datasets/counts_frames.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

// The trajectories were rendered at 30 frames a second.
inline constexpr double kIclNuimFrameRate = 30;

[[nodiscard]] inline bool is_numbered_image(const std::filesystem::path& name) {
  return is_image_name(name) && all_digits(name.stem().string());
}

[[nodiscard]] inline bool has_numbered_images(const std::filesystem::path& root) {
  return !list_files(root / "rgb", is_numbered_image).empty();
}

// The published name: livingRoom0.gt.freiburg, traj0.gt.freiburg; empty: none.
[[nodiscard]] inline std::filesystem::path find_published_truth(const std::filesystem::path& root) {
  const auto published = list_files(root, [](const auto& name) { return name.extension() == ".freiburg"; });
  return published.empty() ? std::filesystem::path{} : published.front();
}

// groundtruth.txt, or the published one; empty: none.
[[nodiscard]] inline std::filesystem::path find_icl_nuim_truth(const std::filesystem::path& root) {
  std::error_code ignored;
  if (std::filesystem::exists(root / "groundtruth.txt", ignored)) return root / "groundtruth.txt";
  return find_published_truth(root);
}

// A folder whose numbered images are nobody's in particular: no list, no truth, no sensor beside them.
[[nodiscard]] inline bool has_images_alone(const std::filesystem::path& root) {
  std::error_code ignored;
  for (const char* name : {"groundtruth.txt", "associations.txt", "depth.txt", "accelerometer.txt"})
    if (std::filesystem::exists(root / name, ignored)) return false;
  return find_published_truth(root).empty();
}

// With depth beside them, such images are colour and depth folders.
[[nodiscard]] inline bool is_icl_nuim(const std::filesystem::path& root) {
  return has_numbered_images(root) && !(has_images_alone(root) && holds_files(root / "depth"));
}

// Images with numbers for names are nothing special: a folder in the layout of TUM RGB-D that has lost its
// rgb.txt may have them too, and its poses and stamps mean something else.
inline void require_icl_nuim(const std::filesystem::path& root) {
  if (!find_published_truth(root).empty() || counts_frames(root / "groundtruth.txt") ||
      counts_frames(root / "associations.txt"))
    return;
  throw Error(
      root.string() +
      ": nothing says what its rgb/N.png are; expected rgb.txt (TUM RGB-D), or *.freiburg, groundtruth.txt "
      "or associations.txt with frame numbers as stamps (ICL-NUIM); for the images alone name " +
      (root / "rgb").string());
}

[[nodiscard]] inline Dataset read_icl_nuim(const std::filesystem::path& root) {
  require_icl_nuim(root);
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
  attach_truth_file(dataset, find_icl_nuim_truth(root), true);
  return dataset;
}

}  // namespace sslam::io
