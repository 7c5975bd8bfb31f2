// SPDX-License-Identifier: BSD-3-Clause
// The layout of EuRoC (Burri et al., IJRR 2016), TUM-VI and other recordings of the ASL: mav0/cam0/data.csv
// with rows of `nanoseconds,file`, the images in mav0/cam0/data, the body's poses beside cam0.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "sslam/io/datasets/body_poses.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/datasets/file_list.hpp"
#include "sslam/io/datasets/image_folder.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/trajectories/read_trajectory.hpp"

namespace sslam::io {

namespace euroc_detail {

[[nodiscard]] inline bool is_camera(const std::filesystem::path& folder, bool named) {
  std::error_code ignored;
  const auto has = [&](const char* name) { return std::filesystem::is_regular_file(folder / name, ignored); };
  const bool images = is_image_folder(folder / "data");
  return named ? images || has("data.csv") : images && (has("data.csv") || has("sensor.yaml"));
}

}  // namespace euroc_detail

// The folder of the camera of `root`, which may be the recording, its mav0 or the camera itself; empty: none.
[[nodiscard]] inline std::filesystem::path find_euroc_camera(const std::filesystem::path& root) {
  for (const char* place : {"mav0/cam0", "cam0"})
    if (euroc_detail::is_camera(root / place, true)) return root / place;
  return euroc_detail::is_camera(root, false) ? root : std::filesystem::path{};
}

[[nodiscard]] inline bool is_euroc(const std::filesystem::path& root) {
  return !find_euroc_camera(root).empty();
}

// The poses are the body's; where the camera sits on it, T_BS of its sensor.yaml says, or Kalibr's T_cam_imu.
inline void attach_euroc_truth(Dataset& dataset, const std::filesystem::path& mav,
                               const std::filesystem::path& sensor, const std::filesystem::path& chain) {
  std::error_code ignored;
  for (const char* name : {"state_groundtruth_estimate0", "mocap0"}) {
    const std::filesystem::path file = mav / name / "data.csv";
    if (!std::filesystem::is_regular_file(file, ignored)) continue;
    attach_or_leave_out(dataset, [&] {
      const bool has_sensor = std::filesystem::is_regular_file(sensor, ignored);
      if (!has_sensor && !std::filesystem::is_regular_file(chain, ignored))
        throw Error(file.string() + ": holds the body's poses, and without T_BS in " + sensor.string() +
                    " the camera's are not known");
      const SE3<double> body_from_cam =
          has_sensor ? read_yaml_pose(sensor, "T_BS") : read_yaml_pose(chain, "T_cam_imu").inverse();
      Warnings notes;
      Trajectory truth = read_trajectory(file, notes);
      std::erase(notes, file.string() + ": " + unit_note(kNanoseconds));  // as the layout has them
      dataset.warnings.insert(dataset.warnings.end(), notes.begin(), notes.end());
      attach_body_truth(dataset, std::move(truth), body_from_cam, file);
    });
    return;
  }
}

[[nodiscard]] inline Dataset read_euroc(const std::filesystem::path& root) {
  // With its full name: the poses are in the folder above.
  std::error_code ignored;
  const std::filesystem::path found = find_euroc_camera(root);
  const std::filesystem::path camera = found == root ? std::filesystem::canonical(root, ignored) : found;
  const std::filesystem::path list = camera / "data.csv";
  Dataset dataset;
  if (std::filesystem::is_regular_file(list, ignored)) {
    take_listed_frames(dataset,
                       read_file_list(list, camera / "data", dataset.warnings, {.unit = kNanoseconds}), list);
  } else {
    const auto images = list_files(camera / "data", is_image_name);
    if (stamps_of_names(images).seconds.empty())
      throw Error(list.string() + ": is missing, and the names in " + (camera / "data").string() +
                  " are no stamps in nanoseconds");
    dataset = frames_from_images(camera / "data", images, kDefaultFrameRate);
  }
  dataset.layout = Layout::kEuroc;
  dataset.root = root;
  const std::filesystem::path mav = camera.parent_path(), sensor = camera / "sensor.yaml";
  const std::filesystem::path chain = mav / "../dso/camchain.yaml";
  for (const std::filesystem::path& file : {chain, sensor})
    if (std::filesystem::is_regular_file(file, ignored)) dataset.camera_file = file;
  attach_euroc_truth(dataset, mav, sensor, chain);
  return dataset;
}

}  // namespace sslam::io
