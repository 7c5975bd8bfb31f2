// SPDX-License-Identifier: BSD-3-Clause
// One door to all readers: tells the layout from what lies in the folder.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/io/datasets/arkit_scenes.hpp"
#include "sslam/io/datasets/bag_files.hpp"
#include "sslam/io/datasets/colmap_folder.hpp"
#include "sslam/io/datasets/colour_depth.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/euroc.hpp"
#include "sslam/io/datasets/icl_nuim.hpp"
#include "sslam/io/datasets/image_folder.hpp"
#include "sslam/io/datasets/kitti_raw.hpp"
#include "sslam/io/datasets/nearest_layout.hpp"
#include "sslam/io/datasets/numbered_poses.hpp"
#include "sslam/io/datasets/openloris.hpp"
#include "sslam/io/datasets/other_recordings.hpp"
#include "sslam/io/datasets/seven_scenes.hpp"
#include "sslam/io/datasets/stray_scanner.hpp"
#include "sslam/io/datasets/tartanair.hpp"
#include "sslam/io/datasets/transforms_folder.hpp"
#include "sslam/io/datasets/tum.hpp"
#include "sslam/io/datasets/unread_images.hpp"
#include "sslam/io/datasets/uzh_fpv.hpp"
#include "sslam/io/datasets/video.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/io/files/video_content.hpp"

namespace sslam::io {

// What a folder can be, in the order in which it is tried.
struct FolderLayout {
  using Path = std::filesystem::path;
  Layout layout;
  std::string_view name;
  std::string_view looks_for;
  bool (*matches)(const Path& root);
  Dataset (*read)(const Path& root, const OpenOptions& options);
};

inline constexpr std::array<FolderLayout, 19> kFolderLayouts{{
    {Layout::kTum, "TUM RGB-D", "rgb.txt", is_tum,
     [](const FolderLayout::Path& root, const OpenOptions&) { return read_tum(root); }},
    {Layout::kSevenScenes, "7-Scenes", "frame-NNNNNN.color.png", is_seven_scenes,
     [](const FolderLayout::Path& root, const OpenOptions&) { return read_seven_scenes(root); }},
    {Layout::kEuroc, "EuRoC, TUM-VI", "mav0/cam0/data.csv", is_euroc,
     [](const FolderLayout::Path& root, const OpenOptions&) { return read_euroc(root); }},
    {Layout::kKitti, "KITTI odometry", "image_0/NNNNNN.png", is_kitti,
     [](const FolderLayout::Path& root, const OpenOptions&) { return read_kitti(root); }},
    {Layout::kKittiRaw, "KITTI raw", "image_00/data/N.png with image_00/timestamps.txt", is_kitti_raw,
     [](const FolderLayout::Path& root, const OpenOptions&) { return read_kitti_raw(root); }},
    {Layout::kReplica, "Replica", "results/frameNNNNNN.jpg", is_replica,
     [](const FolderLayout::Path& root, const OpenOptions&) { return read_replica(root); }},
    {Layout::kScanNet, "ScanNet", "color/N.jpg with pose/ and intrinsic/", is_scannet,
     [](const FolderLayout::Path& root, const OpenOptions& options) {
       return read_scannet(root, options.frame_rate);
     }},
    {Layout::kOpenLoris, "OpenLORIS", "color.txt with aligned_depth.txt", is_openloris,
     [](const FolderLayout::Path& root, const OpenOptions&) { return read_openloris(root); }},
    {Layout::kTartanAir, "TartanAir", "image_left/NNNNNN_left.png", is_tartanair,
     [](const FolderLayout::Path& root, const OpenOptions& options) {
       return read_tartanair(root, options.frame_rate);
     }},
    {Layout::kUzhFpv, "UZH-FPV", "left_images.txt or images.txt with rows of 'id stamp file'", is_uzh_fpv,
     [](const FolderLayout::Path& root, const OpenOptions&) { return read_uzh_fpv(root); }},
    {Layout::kArkitScenes, "ARKitScenes", "lowres_wide/ID_STAMP.png with lowres_wide_intrinsics/",
     is_arkit_scenes,
     [](const FolderLayout::Path& root, const OpenOptions&) { return read_arkit_scenes(root); }},
    {Layout::kVideo, "Stray Scanner", "rgb.mp4 with odometry.csv", is_stray_scan,
     [](const FolderLayout::Path& root, const OpenOptions&) { return read_stray_scan(root); }},
    {Layout::kTransforms, "transforms.json", "transforms.json, or transforms_train.json, with file_path",
     is_transforms_folder,
     [](const FolderLayout::Path& root, const OpenOptions& options) {
       return read_transforms_folder(root, options.frame_rate);
     }},
    {Layout::kIclNuim, "ICL-NUIM", "rgb/N.png", is_icl_nuim,
     [](const FolderLayout::Path& root, const OpenOptions&) { return read_icl_nuim(root); }},
    {Layout::kColourDepth, "colour and depth folders", "color/ with depth/", is_colour_depth,
     [](const FolderLayout::Path& root, const OpenOptions& options) {
       return read_colour_depth(root, options.frame_rate);
     }},
    {Layout::kColmap, "COLMAP", "images/ with sparse/0/images.txt or .bin", is_colmap_folder,
     [](const FolderLayout::Path& root, const OpenOptions& options) {
       return read_colmap_folder(root, options.frame_rate);
     }},
    {Layout::kTimedImages, "TUM mono", "images/ with times.txt", is_timed_folder,
     [](const FolderLayout::Path& root, const OpenOptions& options) {
       return read_timed_folder(root, options.frame_rate);
     }},
    {Layout::kBag, "ROS bag", "*.mcap or *.db3", is_bag_folder,
     [](const FolderLayout::Path& root, const OpenOptions&) { return unread_bag(root); }},
    {Layout::kImages, "folder of images", "*.png, *.jpg, ...", is_image_folder,
     [](const FolderLayout::Path& root, const OpenOptions& options) {
       return read_image_folder(root, options.frame_rate);
     }},
}};

[[nodiscard]] constexpr std::string_view name(Layout layout) noexcept {
  if (layout == Layout::kVideo) return "video";  // also of a scan
  for (const FolderLayout& known : kFolderLayouts) {
    if (known.layout == layout) return known.name;
  }
  return "stream";
}

[[nodiscard]] inline std::string describe_folder_layouts() {
  std::string text;
  for (const FolderLayout& known : kFolderLayouts) {
    add_to_list(text, std::string(known.looks_for) + " (" + std::string(known.name) + ")");
  }
  return text;
}

// What can be opened below a folder, to name in its place; empty: nothing. Looks two folders deep.
[[nodiscard]] inline std::string datasets_below(const std::filesystem::path& root, int deep = 2) {
  constexpr std::size_t kMost = 4;  // to name
  std::vector<std::filesystem::path> found =
      list_files(root, [](const auto& name) { return is_video_name(name) || is_bag_name(name); });
  std::vector<std::filesystem::path> folders = list_folders(root);
  constexpr std::size_t kMostFolders = 20;  // to look into
  folders.resize(std::min(folders.size(), kMostFolders));
  for (const std::filesystem::path& folder : folders)
    if (std::any_of(kFolderLayouts.begin(), kFolderLayouts.end(),
                    [&folder](const FolderLayout& known) { return known.matches(folder); }))
      found.push_back(folder);
  std::string list;
  for (std::size_t i = 0; i < std::min(found.size(), kMost); ++i) add_to_list(list, found[i].string());
  if (found.size() > kMost) add_to_list(list, "...");
  for (std::size_t i = 0; deep > 1 && list.empty() && i < folders.size(); ++i)
    list = datasets_below(folders[i], deep - 1);
  return list;
}

// path: a folder in one of the layouts, a glob of images, a video, or a bag. Throws Error for anything
// else.
[[nodiscard]] inline Dataset open_dataset(const std::filesystem::path& path,
                                          const OpenOptions& options = {}) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (path.empty()) throw Error("the name of the dataset is empty; expected a folder, a video or a bag");
  if (!std::filesystem::exists(status)) {
    if (has_wildcards(path.string())) return read_image_glob(path, options.frame_rate);
    if (const auto pattern = number_pattern(path.filename().string()))
      return read_numbered_images(path, *pattern, options.frame_rate);
    throw Error(path.string() + ": no such file or folder");
  }
  if (!std::filesystem::is_directory(status)) {
    if (std::filesystem::is_regular_file(status) && is_video_file(path)) return read_video(path);
    if (is_bag_name(path)) return unread_bag(path);
    if (is_image_name(path))
      throw Error(path.string() + ": is one image; a run needs many: name their folder, or a glob in quotes");
    if (const std::string other = other_recording(path); !other.empty())
      throw Error(path.string() + ": " + other);
    throw Error(
        path.string() +
        ": is neither a folder nor a video (mp4, avi, mkv, mov, webm, ...) nor a bag (bag, mcap, db3)");
  }
  for (const FolderLayout& known : kFolderLayouts) {
    if (known.matches(path)) return known.read(path, options);
  }
  if (const std::string unread = unread_images(path); !unread.empty())
    throw Error(path.string() + ": no dataset here: " + unread);
  const bool empty = std::filesystem::is_empty(path, ignored);
  const std::string nearest = nearest_layout(path), below = datasets_below(path);
  throw Error(path.string() + (empty ? ": the folder is empty" : ": no dataset here") +
              (below.empty() ? "" : "; below it, and to be named themselves, are " + below) +
              (nearest.empty() ? "" : "; " + nearest) + "; looked for " + describe_folder_layouts());
}

}  // namespace sslam::io
