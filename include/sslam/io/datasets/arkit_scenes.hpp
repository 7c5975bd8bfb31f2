// SPDX-License-Identifier: BSD-3-Clause
// The layout of ARKitScenes (Baruch et al., NeurIPS 2021): lowres_wide/ID_STAMP.png, depth of the same names
// in lowres_depth/, a .pincam an image in lowres_wide_intrinsics/, poses in lowres_wide.traj. Larger images
// lie in vga_wide/ or wide/, without depth of their size.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/io/datasets/colour_depth.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

namespace arkit_scenes_detail {

// Seconds, behind the last underscore of a name.
[[nodiscard]] inline std::optional<double> stamp_of(const std::filesystem::path& image) {
  const std::string stem = image.stem().string();
  const std::size_t mark = stem.rfind('_');
  return mark == std::string::npos ? std::nullopt : parse_number<double>(stem.substr(mark + 1));
}

[[nodiscard]] inline bool is_image(const std::filesystem::path& name) {
  return is_image_name(name) && stamp_of(name);
}

[[nodiscard]] inline bool is_pincam(const std::filesystem::path& name) {
  return name.extension() == ".pincam";
}

// The folder of images; empty: none. The detection set keeps them in ID_frames/.
[[nodiscard]] inline std::filesystem::path find_images(const std::filesystem::path& root) {
  std::vector<std::filesystem::path> places{root};
  for (const std::filesystem::path& folder : list_folders(root))
    if (folder.filename().string().ends_with("_frames")) places.push_back(folder);
  for (const std::filesystem::path& place : places)
    for (const char* name : {"lowres_wide", "vga_wide", "wide"}) {
      const std::filesystem::path cameras = place / (std::string(name) + "_intrinsics");
      if (!list_files(cameras, is_pincam).empty() && !list_files(place / name, is_image).empty())
        return place / name;
    }
  return {};
}

// The phone focuses anew: the camera is that of the image in the middle of the recording, and how far the
// others are from it is told.
inline void take_camera(Dataset& dataset, const std::vector<std::filesystem::path>& cameras) {
  dataset.camera_file = cameras[cameras.size() / 2];
  constexpr std::size_t kMost = 200;  // to look at
  double least = 0, most = 0;
  for (std::size_t i = 0; i < cameras.size(); i += 1 + cameras.size() / kMost) {
    const std::string text = read_plain_text(cameras[i]);
    const std::vector<std::string_view> cells =
        split_cells(std::string_view(text).substr(0, text.find('\n')));
    const double focal = cells.size() == 6 ? parse_number<double>(cells[2]).value_or(0) : 0;
    if (focal <= 0) continue;
    least = least == 0 ? focal : std::min(least, focal);
    most = std::max(most, focal);
  }
  constexpr double kSame = 1.005;
  char text[160];
  std::snprintf(text, sizeof text,
                ": the focal length changes from %.6g to %.6g pixels, and one camera is taken for all images",
                least, most);
  if (most > kSame * least) dataset.warnings.push_back(dataset.camera_file.parent_path().string() + text);
}

}  // namespace arkit_scenes_detail

[[nodiscard]] inline bool is_arkit_scenes(const std::filesystem::path& root) {
  return !arkit_scenes_detail::find_images(root).empty();
}

[[nodiscard]] inline Dataset read_arkit_scenes(const std::filesystem::path& root) {
  using namespace arkit_scenes_detail;
  constexpr double kMillimetres = 1000;
  const std::filesystem::path images = find_images(root), place = images.parent_path();
  Dataset dataset;
  dataset.layout = Layout::kArkitScenes;
  dataset.root = root;
  for (const std::filesystem::path& image : list_files(images, is_image)) {
    FrameEntry frame;
    frame.stamp = *stamp_of(image);
    frame.image = image.string();
    dataset.frames.push_back(std::move(frame));
  }
  drop_bad_frames(dataset, images);
  take_camera(dataset, list_files(place / (images.filename().string() + "_intrinsics"), is_pincam));
  if (const auto depth = place / "lowres_depth"; images.filename() == "lowres_wide" && holds_files(depth)) {
    dataset.depth_factor = kMillimetres;
    attach_depth_folder(dataset, depth);
  }
  for (const std::filesystem::path& poses : {place / "lowres_wide.traj", root / "lowres_wide.traj"})
    if (dataset.ground_truth.empty() && dataset.truth_problem.empty()) attach_truth_file(dataset, poses);
  return dataset;
}

}  // namespace sslam::io
