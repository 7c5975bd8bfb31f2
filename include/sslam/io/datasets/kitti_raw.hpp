// SPDX-License-Identifier: BSD-3-Clause
// The raw recordings of KITTI (Geiger et al., IJRR 2013) and of KITTI-360: image_00/data/NNNNNNNNNN.png, or
// data_rect, with timestamps.txt of dates beside it, the calibration in a folder above, poses in oxts/ or in
// data_poses/.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/datasets/kitti_calibration.hpp"
#include "sslam/io/datasets/kitti_oxts.hpp"
#include "sslam/io/datasets/numbered_poses.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/plain_text.hpp"

namespace sslam::io {

// Where its parts lie.
struct KittiRawPlace {
  std::filesystem::path drive, images, stamps;
  std::string camera;      // "00" to "03"
  bool rectified = false;  // the images are
};

namespace kitti_raw_detail {

// The camera of a folder image_02 that has images and stamps.
[[nodiscard]] inline std::optional<KittiRawPlace> place_of(const std::filesystem::path& camera) {
  const std::string name = camera.filename().string();
  std::error_code ignored;
  if (!name.starts_with("image_0") || name.size() != 8 ||
      !std::filesystem::is_regular_file(camera / "timestamps.txt", ignored))
    return std::nullopt;
  const auto numbered = [](const std::filesystem::path& file) {
    return is_image_name(file) && all_digits(file.stem().string());
  };
  for (const char* folder : {"data", "data_rect"})
    if (!list_files(camera / folder, numbered).empty()) {
      const std::filesystem::path drive = camera.parent_path();
      const bool raw = drive.filename().string().find("extract") != std::string::npos;
      return KittiRawPlace{drive, camera / folder, camera / "timestamps.txt", name.substr(6), !raw};
    }
  return std::nullopt;
}

}  // namespace kitti_raw_detail

// `root`: the drive (its left grey camera, else the left colour camera), a camera of it, or that camera's
// images.
[[nodiscard]] inline std::optional<KittiRawPlace> find_kitti_raw(const std::filesystem::path& root) {
  std::error_code ignored;
  const std::filesystem::path full = std::filesystem::weakly_canonical(root / ".", ignored);
  const std::filesystem::path folder = full.has_filename() ? full : full.parent_path();
  for (const char* camera : {"image_00", "image_02"})
    if (auto place = kitti_raw_detail::place_of(folder / camera)) return place;
  if (auto place = kitti_raw_detail::place_of(folder)) return place;
  auto place = kitti_raw_detail::place_of(folder.parent_path());
  return place && place->images == folder ? place : std::nullopt;
}

[[nodiscard]] inline bool is_kitti_raw(const std::filesystem::path& root) {
  return find_kitti_raw(root).has_value();
}

// KITTI-360: rows of a number and a 4x4 matrix, those of camera 00. `stamps`: of the images, by number.
inline void attach_numbered_matrices(Dataset& dataset, const std::filesystem::path& file,
                                     const std::vector<double>& stamps) {
  attach_or_leave_out(dataset, [&] {
    const PoseFile poses = read_pose_file(file, dataset.warnings, kNoTimes);
    Trajectory truth;
    for (const StampedPose& pose : poses.trajectory)
      if (pose.stamp >= 0 && pose.stamp < static_cast<double>(stamps.size()))
        truth.push_back({stamps[static_cast<std::size_t>(pose.stamp)], pose.world_from_cam});
    attach_ground_truth(dataset, std::move(truth), file);
  });
}

[[nodiscard]] inline Dataset read_kitti_raw(const std::filesystem::path& root) {
  const KittiRawPlace place = find_kitti_raw(root).value();
  Dataset dataset;
  dataset.layout = Layout::kKittiRaw;
  dataset.root = root;
  Warnings dates;  // as the layout has them
  const std::vector<double> stamps = read_times(place.stamps, dates);
  for (const std::filesystem::path& image : list_files(place.images, is_image_name)) {
    const auto number = number_of(image);
    if (!number) continue;
    if (*number >= stamps.size())
      throw Error(place.stamps.string() + ": has " + std::to_string(stamps.size()) + " times and none for " +
                  image.filename().string() + "; expected one an image, from 0 on");
    FrameEntry frame;
    frame.stamp = stamps[*number];
    frame.image = image.string();
    dataset.frames.push_back(std::move(frame));
  }
  drop_bad_frames(dataset, place.images);
  const std::filesystem::path day = place.drive.parent_path(), set = day.parent_path();
  const std::filesystem::path calibration =
      first_file({place.drive / "calib_cam_to_cam.txt", day / "calib_cam_to_cam.txt",
                  set / "calib_cam_to_cam.txt", set / "calibration/perspective.txt"});
  if (!calibration.empty()) {
    const std::string text = read_plain_text(calibration);
    dataset.camera_text = kitti_camera_text(text, place.camera, place.rectified);
    dataset.camera_source = calibration.string() + " (camera " + place.camera +
                            (place.rectified ? ", rectified images)" : ", images not rectified)");
  }
  if (std::filesystem::is_directory(place.drive / "oxts/data")) {
    attach_oxts(dataset, place.drive / "oxts", calibration, place.camera, place.rectified, stamps);
  } else if (const auto poses =
                 first_file({set / "data_poses" / place.drive.filename() / "cam0_to_world.txt"});
             !poses.empty() && place.camera == "00") {
    attach_numbered_matrices(dataset, poses, stamps);
  }
  return dataset;
}

}  // namespace sslam::io
