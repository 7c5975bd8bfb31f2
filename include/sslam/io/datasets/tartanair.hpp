// SPDX-License-Identifier: BSD-3-Clause
// The layout of TartanAir (Wang et al., IROS 2020): image_left/NNNNNN_left.png with a pose a row in
// pose_left.txt; of TartanAir V2 image_lcam_front/NNNNNN_lcam_front.png and pose_lcam_front.txt.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "sslam/io/datasets/colour_depth.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/image_folder.hpp"
#include "sslam/io/files/files.hpp"

namespace sslam::io {

namespace tartanair_detail {

// What a version calls its left camera, and that camera as published: 90 degrees across.
struct Version {
  std::string_view camera, calibration;
};

inline constexpr std::array<Version, 2> kVersions{
    {{"left",
      "Camera.fx: 320\nCamera.fy: 320\nCamera.cx: 320\nCamera.cy: 240\nCamera.width: 640\nCamera.height: "
      "480\n"},
     {"lcam_front",
      "Camera.fx: 320\nCamera.fy: 320\nCamera.cx: 320\nCamera.cy: 320\nCamera.width: 640\nCamera.height: "
      "640\n"}}};

[[nodiscard]] inline std::filesystem::path images_of(const std::filesystem::path& root,
                                                     const Version& version) {
  return root / ("image_" + std::string(version.camera));
}

// Null: it is none.
[[nodiscard]] inline const Version* version_of(const std::filesystem::path& root) {
  for (const Version& version : kVersions) {
    const auto named = [end = "_" + std::string(version.camera)](const std::filesystem::path& name) {
      return is_image_name(name) && name.stem().string().ends_with(end);
    };
    if (!list_files(images_of(root, version), named).empty()) return &version;
  }
  return nullptr;
}

// The poses' axes are x forwards, y to the right, z down.
[[nodiscard]] inline SE3<double> forwards_from_cam() {
  Mat3<double> turn;
  turn << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  SE3<double> pose;
  pose.rotation = SO3<double>::from_matrix(turn);
  return pose;
}

}  // namespace tartanair_detail

[[nodiscard]] inline bool is_tartanair(const std::filesystem::path& root) {
  return tartanair_detail::version_of(root) != nullptr;
}

// Its depth is in arrays of NumPy, or in the colours of images, and is left out.
[[nodiscard]] inline Dataset read_tartanair(const std::filesystem::path& root, double frame_rate) {
  using namespace tartanair_detail;
  const Version& version = *version_of(root);
  Dataset dataset = read_image_folder(images_of(root, version), frame_rate);
  dataset.layout = Layout::kTartanAir;
  dataset.root = root;
  dataset.camera_text = version.calibration;
  dataset.camera_source = "TartanAir, as published";
  const std::string name(version.camera);
  if (const auto depth = root / ("depth_" + name); holds_files(depth))
    dataset.warnings.push_back(depth.string() +
                               ": is depth in a form of TartanAir's own, which is not read: left out");
  if (const auto poses = first_file({root / ("pose_" + name + ".txt")}); !poses.empty())
    attach_pose_rows(dataset, poses, forwards_from_cam());
  return dataset;
}

}  // namespace sslam::io
