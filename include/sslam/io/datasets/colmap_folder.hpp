// SPDX-License-Identifier: BSD-3-Clause
// A folder as COLMAP works in, and as Gaussian splatting takes it: images/ and a model in sparse/0, with the
// cameras and the poses of the images.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/core/colmap_cameras.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/datasets/dataset_filling.hpp"
#include "sslam/io/datasets/image_folder.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/plain_text.hpp"
#include "sslam/io/trajectories/colmap_images.hpp"

namespace sslam::io {

namespace colmap_folder_detail {

[[nodiscard]] inline bool has(const std::filesystem::path& folder, const char* file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(folder / file, ignored);
}

// The images in which the model's lie: images/, or the folder itself.
[[nodiscard]] inline std::filesystem::path find_images(const std::filesystem::path& root) {
  std::error_code ignored;
  return std::filesystem::is_directory(root / "images", ignored) ? root / "images" : root;
}

[[nodiscard]] inline std::vector<NamedPose> read_images(const std::filesystem::path& model) {
  if (has(model, "images.bin")) return read_colmap_binary(model / "images.bin");
  const std::string text = read_plain_text(model / "images.txt");
  return read_colmap_text(model / "images.txt", split_rows(text));
}

// In which the images lie, as their names say.
[[nodiscard]] inline std::set<std::string> folders_of(const std::vector<NamedPose>& poses) {
  std::set<std::string> folders;
  for (const NamedPose& pose : poses) folders.insert(std::filesystem::path(pose.name).parent_path().string());
  return folders;
}

// The names of the sequence in natural order: all images of the folder where the model's lie in it alone,
// since the model may leave some out; else those of the model.
[[nodiscard]] inline std::vector<std::filesystem::path> sequence(const std::filesystem::path& images,
                                                                 const std::set<std::string>& folders,
                                                                 const std::vector<NamedPose>& poses) {
  if (folders.size() == 1)
    if (auto all = list_files(images / *folders.begin(), is_image_name); !all.empty()) return all;
  std::vector<std::filesystem::path> named;
  named.reserve(poses.size());
  for (const NamedPose& pose : poses) named.push_back(images / pose.name);
  std::sort(named.begin(), named.end(),
            [](const auto& a, const auto& b) { return natural_less(a.string(), b.string()); });
  return named;
}

// The camera that most images have.
inline void choose_camera(Dataset& dataset, const std::filesystem::path& model,
                          const std::vector<NamedPose>& poses) {
  const bool binary = has(model, "cameras.bin");
  const std::filesystem::path file = model / (binary ? "cameras.bin" : "cameras.txt");
  const std::vector<ColmapCamera> cameras =
      binary ? parse_colmap_binary(read_text(file), file.string()) : parse_colmap_rows(read_plain_text(file));
  std::map<std::int64_t, std::size_t> uses;
  for (const NamedPose& pose : poses) ++uses[pose.camera];
  const std::size_t several = uses.size();
  const ColmapCamera* best = nullptr;
  for (const ColmapCamera& camera : cameras)
    if (best == nullptr || uses[camera.id] > uses[best->id]) best = &camera;
  if (best == nullptr) throw Error(file.string() + ": holds no camera; expected COLMAP's rows of cameras");
  dataset.camera_text = best->row + "\n";
  dataset.camera_source = file.string();
  if (several > 1)
    dataset.warnings.push_back(file.string() + ": the images have " + std::to_string(several) +
                               " cameras; camera " + std::to_string(best->id) + ", of " +
                               std::to_string(uses[best->id]) + " of " + std::to_string(poses.size()) +
                               " images, is taken for all");
}

}  // namespace colmap_folder_detail

// The folder of the model; empty: none.
[[nodiscard]] inline std::filesystem::path find_colmap_model(const std::filesystem::path& root) {
  using colmap_folder_detail::has;
  for (const char* place : {"sparse/0", "sparse", "colmap/sparse/0", "colmap/sparse", "model"}) {
    const std::filesystem::path folder = root / place;
    if ((has(folder, "images.txt") || has(folder, "images.bin")) &&
        (has(folder, "cameras.txt") || has(folder, "cameras.bin")))
      return folder;
  }
  return {};
}

[[nodiscard]] inline bool is_colmap_folder(const std::filesystem::path& root) {
  return !find_colmap_model(root).empty();
}

// The names give the order. Throws Error where the model cannot be read, or its images are not there.
[[nodiscard]] inline Dataset read_colmap_folder(const std::filesystem::path& root, double frame_rate) {
  const std::filesystem::path model = find_colmap_model(root),
                              images = colmap_folder_detail::find_images(root);
  const std::vector<NamedPose> poses = colmap_folder_detail::read_images(model);
  if (poses.empty()) throw Error(model.string() + ": holds no image; expected the images of a COLMAP model");
  const std::set<std::string> folders = colmap_folder_detail::folders_of(poses);
  Dataset dataset =
      frames_from_images(images, colmap_folder_detail::sequence(images, folders, poses), frame_rate);
  dataset.layout = Layout::kColmap;
  dataset.root = root;
  colmap_folder_detail::choose_camera(dataset, model, poses);
  std::map<std::string, const NamedPose*> by_file;
  for (const NamedPose& pose : poses) by_file.emplace((images / pose.name).string(), &pose);
  for (FrameEntry& frame : dataset.frames) {
    const auto pose = by_file.find(frame.image);
    if (pose == by_file.end()) continue;
    frame.truth = static_cast<std::ptrdiff_t>(dataset.ground_truth.size());
    dataset.ground_truth.push_back({frame.stamp, pose->second->world_from_cam});
  }
  if (folders.size() > 1)
    dataset.warnings.push_back(model.string() + ": its images lie in " + std::to_string(folders.size()) +
                               " folders; they are taken as one sequence, folder after folder");
  if (dataset.ground_truth.size() < dataset.frames.size())
    dataset.warnings.push_back(model.string() + ": has poses of " +
                               std::to_string(dataset.ground_truth.size()) + " of the " +
                               std::to_string(dataset.frames.size()) + " images");
  dataset.warnings.push_back(model.string() +
                             ": the ground truth is COLMAP's, in its unit, which need not be metres");
  return dataset;
}

}  // namespace sslam::io
