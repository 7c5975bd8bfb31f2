// SPDX-License-Identifier: BSD-3-Clause
// Which calibration a run uses: --camera, else camera.yaml in the dataset, else a published one for the
// dataset.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "sslam/core/error.hpp"
#include "sslam/io/datasets/known_cameras.hpp"
#include "sslam/opencv/camera/camera_file.hpp"

namespace sslam::cli {

struct CameraChoice {
  Camera<double> camera;    // width and height are 0 when the source does not give them
  double depth_factor = 0;  // depth image units a metre; 0: not known
  double frame_rate = 0;    // frames a second; 0: not known
  std::string source;       // for the report: a path or a name
};

[[nodiscard]] inline CameraChoice camera_from_file(const std::filesystem::path& path) {
  const CameraFile file = read_camera_file(path);
  return {file.camera, file.depth_factor, file.frame_rate, path.string()};
}

[[nodiscard]] inline CameraChoice camera_from_known(const io::KnownCamera& known) {
  return {known.camera, known.depth_factor, known.frame_rate, "built in: " + std::string(known.name)};
}

// wanted: what --camera gave, a file or the name of a built-in calibration; empty: not given. A depth factor
// that the chosen file leaves out is taken from the published values of the dataset, where there are any.
// Nothing when nothing is known about the camera. Throws when the file is wrong.
[[nodiscard]] inline std::optional<CameraChoice> find_camera(const std::string& wanted,
                                                             const io::Dataset& dataset) {
  const auto known = io::known_camera_for(dataset);
  const auto complete = [&known](CameraChoice choice) {
    if (choice.depth_factor == 0 && known) choice.depth_factor = known->depth_factor;
    return choice;
  };
  if (!wanted.empty()) {
    std::error_code ignored;
    const auto named = io::find_known_camera(wanted);
    if (named && !std::filesystem::exists(wanted, ignored)) return camera_from_known(*named);
    return complete(camera_from_file(wanted));
  }
  std::error_code ignored;
  const bool folder = std::filesystem::is_directory(dataset.root, ignored);
  const std::filesystem::path own = (folder ? dataset.root : dataset.root.parent_path()) / "camera.yaml";
  if (std::filesystem::exists(own, ignored)) return complete(camera_from_file(own));
  if (known) return camera_from_known(*known);
  return std::nullopt;
}

// As find_camera, for those who need one: throws when nothing is known about the camera.
[[nodiscard]] inline CameraChoice choose_camera(const std::string& wanted, const io::Dataset& dataset) {
  if (auto found = find_camera(wanted, dataset)) return *found;
  throw Error(
      dataset.root.string() + ": the camera is not known; pass --camera FILE (YAML with Camera.fx, ...) or " +
      "the name of a built-in calibration (" + io::known_camera_names() + "), or put a camera.yaml there");
}

}  // namespace sslam::cli
