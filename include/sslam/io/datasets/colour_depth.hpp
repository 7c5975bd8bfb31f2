// SPDX-License-Identifier: BSD-3-Clause
// Folders of colour and depth images side by side, as RealSense's and Open3D's recorders leave them, and
// ScanNet (Dai et al., CVPR 2017), which has pose/ and intrinsic/ too.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslam/geometry/camera.hpp"
#include "sslam/io/datasets/body_poses.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/datasets/image_folder.hpp"
#include "sslam/io/datasets/numbered_poses.hpp"
#include "sslam/io/datasets/pose_files.hpp"
#include "sslam/io/files/files.hpp"

namespace sslam::io {

// Empty: none.
[[nodiscard]] inline std::filesystem::path find_colour_folder(const std::filesystem::path& root) {
  for (const char* name : {"color", "colour", "rgb", "image", "images"})
    if (const auto folder = find_folder(root, name); is_image_folder(folder)) return folder;
  return {};
}

[[nodiscard]] inline bool is_colour_depth(const std::filesystem::path& root) {
  return !find_colour_folder(root).empty() && holds_files(find_folder(root, "depth"));
}

[[nodiscard]] inline bool is_scannet(const std::filesystem::path& root) {
  std::error_code ignored;
  return is_image_folder(root / "color") && std::filesystem::is_directory(root / "pose", ignored) &&
         std::filesystem::is_directory(root / "intrinsic", ignored);
}

// Those of depth images with the number of a colour image at the end of their names, such as depth_12.png for
// rgb_12.png. The number of frames that have one.
[[nodiscard]] inline std::size_t attach_depth_numbers(Dataset& dataset,
                                                      const std::vector<std::filesystem::path>& depths) {
  std::map<std::size_t, const std::filesystem::path*> by_number;
  for (const std::filesystem::path& depth : depths)
    if (const auto number = number_of(depth))
      if (!by_number.emplace(*number, &depth).second) return 0;  // the number is not all of the name
  std::size_t found = 0;
  for (FrameEntry& frame : dataset.frames) {
    const auto number = number_of(frame.image);
    const auto depth = number ? by_number.find(*number) : by_number.end();
    if (depth == by_number.end()) continue;
    frame.depth = depth->second->string();
    ++found;
  }
  return found;
}

// Of a folder whose files are no images.
inline void tell_unread_depth(Dataset& dataset, const std::filesystem::path& folder) {
  const auto files = list_files(folder, [](const auto&) { return true; });
  if (!files.empty())
    dataset.warnings.push_back(folder.string() + ": " + files.front().filename().string() +
                               " is in no format that is read: depth left out; expected images, such as PNG "
                               "of 16 bit or TIFF of 32 bit in metres");
}

// Depth images of the same names; else with stamps for names the nearest in time; else of the same numbers.
inline void attach_depth_folder(Dataset& dataset, const std::filesystem::path& folder) {
  const std::vector<std::filesystem::path> depths = list_files(folder, is_image_name);
  if (depths.empty()) return tell_unread_depth(dataset, folder);
  std::map<std::string, const std::filesystem::path*> by_name;
  for (const std::filesystem::path& depth : depths) {
    const auto [other, alone] = by_name.emplace(depth.stem().string(), &depth);
    if (!alone && lower_case(depth.extension().string()) == ".png") other->second = &depth;  // not a picture
  }
  std::size_t found = 0;
  for (FrameEntry& frame : dataset.frames) {
    const auto same = by_name.find(std::filesystem::path(frame.image).stem().string());
    if (same == by_name.end()) continue;
    frame.depth = same->second->string();
    ++found;
  }
  if (found == 0) {
    const NameStamps named = stamps_of_names(depths);
    for (const StampPair& pair : associate(frame_stamps(dataset), named.seconds, kMaxStampDifference)) {
      dataset.frames[pair.a].depth = depths[pair.b].string();
      ++found;
    }
  }
  if (found == 0) found = attach_depth_numbers(dataset, depths);
  if (found == 0)
    dataset.warnings.push_back(folder.string() +
                               ": none of its images has the name, the time or the number of a colour "
                               "image: depth left out");
}

// A pose a row: of the images in order where there are as many, else row N of image N. Stamps are taken where
// the file has them. `pose_from_cam`: where the poses' axes are not the camera's.
inline void attach_pose_rows(Dataset& dataset, const std::filesystem::path& file,
                             const SE3<double>& pose_from_cam = {}) {
  attach_or_leave_out(dataset, [&] {
    PoseFile poses = read_pose_file(file, dataset.warnings);
    const bool in_order = poses.trajectory.size() + poses.no_pose == dataset.frames.size();
    std::map<std::size_t, double> stamps;  // by row
    for (std::size_t i = 0; i < dataset.frames.size(); ++i) {
      const auto row = in_order ? std::optional(i) : number_of(dataset.frames[i].image);
      if (row) stamps.emplace(*row, dataset.frames[i].stamp);
    }
    Trajectory truth;
    for (const StampedPose& pose : poses.trajectory) {
      if (!poses.counted) truth.push_back(pose);
      const auto stamp = stamps.find(static_cast<std::size_t>(std::max(0.0, pose.stamp)));
      if (poses.counted && stamp != stamps.end()) truth.push_back({stamp->second, pose.world_from_cam});
    }
    order_by_stamp(truth, file, dataset.warnings);
    attach_body_truth(dataset, std::move(truth), pose_from_cam, file);
  });
}

[[nodiscard]] inline Dataset read_colour_depth(const std::filesystem::path& root, double frame_rate) {
  constexpr double kMillimetres = 1000;
  Dataset dataset = read_image_folder(find_colour_folder(root), frame_rate);
  dataset.layout = Layout::kColourDepth;
  dataset.root = root;
  dataset.depth_factor = kMillimetres;
  attach_depth_folder(dataset, find_folder(root, "depth"));
  std::error_code ignored;
  for (const char* name : {"camera_intrinsic.json", "intrinsic.json", "camera_intrinsics.json"})
    if (std::filesystem::is_regular_file(root / name, ignored)) {
      dataset.camera_file = root / name;
      break;
    }
  for (const char* name : {"traj_w_c.txt", "traj.txt", "poses.txt", "groundtruth.txt"})
    if (std::filesystem::is_regular_file(root / name, ignored)) {
      attach_pose_rows(dataset, root / name);
      break;
    }
  return dataset;
}

// The pinhole of a camera matrix in a file; nothing where it holds none.
[[nodiscard]] inline std::optional<Pinhole<double>> read_intrinsics(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return std::nullopt;
  std::vector<double> v;
  const std::string text = read_plain_text(file);
  for (const TextRow& row : split_rows(text))
    for (const std::string_view cell : row.cells) v.push_back(parse_number<double>(cell).value_or(0));
  const std::size_t n = v.size() == 9 ? 3 : 4;
  if ((v.size() != 9 && v.size() != 16) || !(v[0] > 0) || !(v[n + 1] > 0)) return std::nullopt;
  return Pinhole<double>{v[0], v[n + 1], v[2], v[n + 2]};
}

// Whether depth and colour look the same way through the same lens, but for the number of pixels: images of
// both show the same then. Told by the ray to the corner (0, 0), since the files do not tell sizes.
[[nodiscard]] inline bool same_view(const Pinhole<double>& a, const Pinhole<double>& b) noexcept {
  constexpr double kNear = 0.01;  // of a focal length: some pixels
  return std::abs(a.cx / a.fx - b.cx / b.fx) < kNear && std::abs(a.cy / a.fy - b.cy / b.fy) < kNear;
}

// Its depth images have a size and a camera of their own, and are taken where they show the same as colour.
[[nodiscard]] inline Dataset read_scannet(const std::filesystem::path& root, double frame_rate) {
  Dataset dataset = read_image_folder(root / "color", frame_rate);
  dataset.layout = Layout::kScanNet;
  dataset.root = root;
  const auto colour = read_intrinsics(root / "intrinsic/intrinsic_color.txt");
  const auto depth = read_intrinsics(root / "intrinsic/intrinsic_depth.txt");
  if (is_image_folder(root / "depth")) {
    constexpr double kMillimetres = 1000;
    if (colour && depth && same_view(*colour, *depth)) {
      dataset.depth_factor = kMillimetres;
      attach_depth_folder(dataset, root / "depth");
    } else {
      dataset.warnings.push_back(
          (root / "depth").string() +
          ": intrinsic/ does not say that depth and colour show the same: depth left out");
    }
  }
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
