// SPDX-License-Identifier: BSD-3-Clause
// The layout of UZH-FPV (Delmerico et al., ICRA 2019): left_images.txt, or images.txt, with rows of `id stamp
// file`, and groundtruth.txt with the poses of the IMU. The calibration is published apart from it, as
// Kalibr's camchain; it may lie in the folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sslam/core/error.hpp"
#include "sslam/io/datasets/body_poses.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/datasets/file_list.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/files/text.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"

namespace sslam::io {

// COLMAP, too, writes an images.txt, with rows of another kind. Empty: there is none.
[[nodiscard]] inline std::filesystem::path find_counted_list(const std::filesystem::path& root) {
  for (const char* name : {"left_images.txt", "images.txt"}) {
    const std::filesystem::path list = first_file({root / name});
    if (list.empty()) continue;
    try {
      const std::string text = read_plain_text(list);
      if (file_list_detail::are_counted(split_rows(text))) return list;
    } catch (const Error&) {
      continue;  // whoever reads it tells
    }
  }
  return {};
}

[[nodiscard]] inline bool is_uzh_fpv(const std::filesystem::path& root) {
  return !find_counted_list(root).empty();
}

[[nodiscard]] inline Dataset read_uzh_fpv(const std::filesystem::path& root) {
  const std::filesystem::path list = find_counted_list(root);
  Dataset dataset;
  dataset.layout = Layout::kUzhFpv;
  dataset.root = root;
  take_listed_frames(dataset, read_file_list(list, root, dataset.warnings, {.counted = true}), list);
  const std::vector<std::filesystem::path> chains = list_files(root, [](const std::filesystem::path& name) {
    return name.extension() == ".yaml" && name.string().find("camchain") != std::string::npos;
  });
  if (!chains.empty()) dataset.camera_file = chains.front();
  const auto truth = first_file({root / "groundtruth.txt"});
  if (truth.empty()) return dataset;
  attach_or_leave_out(dataset, [&] {
    if (chains.empty())
      throw Error(truth.string() +
                  ": holds the poses of the IMU; the camera's are known with Kalibr's camchain (T_cam_imu), "
                  "which the dataset publishes as its calibration, in this folder");
    const SE3<double> imu_from_cam = read_yaml_pose(chains.front(), "T_cam_imu").inverse();
    attach_body_truth(dataset, read_trajectory(truth, dataset.warnings), imu_from_cam, truth);
  });
  return dataset;
}

}  // namespace sslam::io
