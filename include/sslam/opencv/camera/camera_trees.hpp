// SPDX-License-Identifier: BSD-3-Clause
// Calibrations in YAML, JSON and XML: tells by the keys which program wrote them.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "sslam/opencv/camera/matrix_cameras.hpp"
#include "sslam/opencv/camera/named_cameras.hpp"

namespace sslam {
namespace detail {

[[nodiscard]] inline CameraFile read_camera_tree(const TextNode& root, const std::string& file,
                                                 const std::string& where = {}) {
  const CameraKeys keys(root, file, where);
  const auto starts = [&root](std::string_view prefix) {
    return std::any_of(root.keys.begin(), root.keys.end(),
                       [prefix](const std::string& key) { return key.starts_with(prefix); });
  };
  if (starts("Camera.") || starts("Camera1.")) return read_orb_slam(keys, keys, "Camera.");
  if (const TextNode* const nested = root.find("Camera"); nested != nullptr && nested->has("model"))
    return read_orb_slam(CameraKeys(*nested, file, "Camera."), keys, "");
  const CameraKeys::Names matrices{"camera_matrix",
                                   "Camera_Matrix",
                                   "cameraMatrix",
                                   "intrinsic_matrix",
                                   "K",
                                   "k",
                                   "mtx",
                                   "P_rect_02",
                                   "P2",
                                   "P0"};
  if (keys.has_any(matrices)) return read_matrix_camera(keys, matrices);
  if (const TextNode* const list = root.find("intrinsics");
      list != nullptr && list->kind == TextNode::Kind::kList) {
    constexpr std::size_t kMostOfModel = 6;  // that Kalibr writes; a matrix has more
    const bool matrix = keys.numbers({"intrinsics"}, "fx fy cx cy, or a camera matrix").size() > kMostOfModel;
    return matrix ? read_matrix_camera(keys, {"intrinsics"}) : read_kalibr(keys);
  }
  if (keys.has_any({"fl_x", "camera_angle_x"}) || (keys.has("frames") && where.empty()))
    return read_transforms(keys, root);
  if (keys.has("fx")) return read_plain_names(keys);
  if (where.empty())
    for (const char* part : {"cam0", "color", "rgb", "camera", "Camera", "intrinsics", "intrinsic", "cam"})
      if (const TextNode* const node = root.find(part); node != nullptr && node->kind == TextNode::Kind::kMap)
        return read_camera_tree(*node, file, std::string(part) + ".");
  std::string found;
  for (std::size_t i = 0; i < std::min<std::size_t>(root.keys.size(), 5); ++i)
    found += (i > 0 ? ", " : "") + root.keys[i];
  keys.fail(
      "no calibration of a known kind; expected Camera.fx, camera_matrix, cam0, intrinsics, fl_x or fx" +
      (found.empty() ? std::string() : ", found " + found));
}

}  // namespace detail
}  // namespace sslam
