// SPDX-License-Identifier: BSD-3-Clause
// Which layout a folder that is in none of them comes nearest to, and what it lacks.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace sslam::io {

struct LayoutMarks {
  std::string_view name;
  std::array<std::string_view, 4> marks;  // files and folders of the layout besides the images
  std::string_view images;                // without which it cannot be read
};

inline constexpr std::array<LayoutMarks, 13> kLayoutMarks{{
    {"TUM RGB-D", {"groundtruth.txt", "depth.txt", "accelerometer.txt", "rgb"}, "rgb.txt"},
    {"EuRoC", {"mav0", "mav0/cam0", "cam0", "sensor.yaml"}, "mav0/cam0/data.csv"},
    {"KITTI odometry", {"times.txt", "calib.txt", "image_1", "image_3"}, "image_0/000000.png"},
    {"KITTI raw",
     {"image_00/data", "image_02/data", "oxts", "velodyne_points"},
     "image_00/timestamps.txt or image_02/timestamps.txt"},
    {"Replica", {"traj.txt", "results", "", ""}, "results/frame000000.jpg"},
    {"ScanNet", {"pose", "intrinsic", "color", ""}, "color/0.jpg"},
    {"colour and depth folders", {"depth", "intrinsic.json", "camera_intrinsic.json", ""}, "color/N.png"},
    {"COLMAP", {"sparse", "database.db", "sparse/0", ""}, "sparse/0/images.txt or images.bin, with cameras"},
    {"OpenLORIS",
     {"aligned_depth.txt", "sensors.yaml", "trans_matrix.yaml", "t265_gyroscope.txt"},
     "color.txt"},
    {"TartanAir", {"image_left", "pose_left.txt", "depth_left", "seg_left"}, "image_left/000000_left.png"},
    {"ARKitScenes",
     {"lowres_wide", "lowres_wide.traj", "lowres_depth", "lowres_wide_intrinsics"},
     "lowres_wide/ID_STAMP.png, or lowres_wide_intrinsics/ID_STAMP.pincam,"},
    {"Stray Scanner", {"odometry.csv", "camera_matrix.csv", "confidence", "imu.csv"}, "rgb.mp4"},
    {"nerfstudio or instant-ngp",
     {"transforms_train.json", "transforms.json", "images", "sparse_pc.ply"},
     "transforms.json, or transforms_train.json, with a file_path in its frames"},
}};

// "looks like EuRoC: mav0/cam0/data.csv is missing"; empty where nothing of any layout is there.
[[nodiscard]] inline std::string nearest_layout(const std::filesystem::path& root) {
  const LayoutMarks* nearest = nullptr;
  int most = 0;
  for (const LayoutMarks& layout : kLayoutMarks) {
    int present = 0;
    for (const std::string_view mark : layout.marks) {
      std::error_code ignored;
      present += !mark.empty() && std::filesystem::exists(root / mark, ignored) ? 1 : 0;
    }
    if (present <= most) continue;
    most = present;
    nearest = &layout;
  }
  if (nearest == nullptr) return {};
  return "looks like " + std::string(nearest->name) + ": " + std::string(nearest->images) + " is missing";
}

}  // namespace sslam::io
