// SPDX-License-Identifier: BSD-3-Clause
// Calibrations in YAML, JSON and XML: tells by the keys which program wrote them.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "sslam/opencv/camera/depthai_cameras.hpp"
#include "sslam/opencv/camera/matrix_cameras.hpp"
#include "sslam/opencv/camera/named_cameras.hpp"
#include "sslam/opencv/camera/photo_cameras.hpp"
#include "sslam/opencv/camera/sensor_cameras.hpp"
#include "sslam/opencv/camera/slam_cameras.hpp"

namespace sslam {
namespace detail {

// The one section that holds a camera of named numbers; null: none. Throws Error where several do.
[[nodiscard]] inline const TextNode* only_camera_section(const CameraKeys& keys) {
  const TextNode* found = nullptr;
  std::string names;
  for (std::size_t i = 0; i < keys.map().keys.size(); ++i) {
    if (!keys.map().items[i].has("fx") || !keys.map().items[i].has("cx")) continue;
    names += (found == nullptr ? "" : ", ") + keys.map().keys[i];
    if (found != nullptr && names.size() > 200) break;
    found = &keys.map().items[i];
  }
  if (found != nullptr && names.find(", ") != std::string::npos)
    keys.fail("has several cameras: " + names + "; expected one: keep that of the images alone");
  return found;
}

// What stands before fx, fy, cx and cy in the names of a map, as in camera_fx; empty: nothing. Throws Error
// where there are several.
[[nodiscard]] inline std::string only_prefix(const CameraKeys& keys) {
  std::string found;
  for (const std::string& key : keys.map().keys) {
    if (!key.ends_with("fx") || key.size() == 2) continue;
    const std::string prefix = key.substr(0, key.size() - 2);
    if (!keys.has(prefix + "fy") || !keys.has(prefix + "cx") || !keys.has(prefix + "cy")) continue;
    if (!found.empty())
      keys.fail("has several cameras: " + found + "fx, " + prefix +
                "fx; expected one: keep that of the images alone");
    found = prefix;
  }
  return found;
}

[[nodiscard]] inline CameraFile read_prefixed(const CameraKeys& keys, const std::string& prefix) {
  CameraFile file;
  for (const std::string& before : {prefix, std::string()}) {
    const std::string width = before + "width", height = before + "height";
    if (file.camera.width == 0) file.camera.width = keys.optional_pixels({width});
    if (file.camera.height == 0) file.camera.height = keys.optional_pixels({height});
  }
  read_named_pinhole(keys, prefix, "pinhole", file);
  file.notes.push_back(keys.file() + ": the camera is that of " + prefix + "fx and so on");
  return file;
}

[[nodiscard]] inline CameraFile read_camera_tree(const TextNode& root, const std::string& file,
                                                 const std::string& where = {}) {
  const CameraKeys keys(root, file, where);
  if (where.empty()) {
    if (keys.has("model_type")) return read_vins(keys);
    if (keys.has("cam0_calib")) refuse_vins_settings(keys);
    if (keys.has("value0")) return read_basalt(keys);
    if (is_depthai(root)) return read_depthai(keys);
    if (is_azure_kinect(root)) return read_azure_kinect(keys);
    if (is_openloris_sensors(root)) return read_openloris(keys);
    if (const TextNode* const node = root.find("fisheye_params");
        node != nullptr && node->has("camera_matrix"))
      return read_gyroflow(keys);
    if (keys.has("lensmodel") && keys.has("imagersize")) return read_mrcal(keys);
    if (is_svo(root)) return read_svo(keys);
    if (is_opensfm(root)) return read_opensfm(keys);
    if (lists_cameras(root)) return read_listed_cameras(keys);
    if (const TextNode* const list = root.find("cameras");
        list != nullptr && !list->items.empty() && list->items.front().has("principal_point"))
      return read_okvis(keys);
    if (keys.has("fx_color")) return read_scannet_scene(keys);
  }
  const auto starts = [&root](std::string_view prefix) {
    return std::any_of(root.keys.begin(), root.keys.end(),
                       [prefix](const std::string& key) { return key.starts_with(prefix); });
  };
  if (starts("Camera.") || !numbered_camera(root).empty()) return read_orb_slam(keys, keys, "Camera.");
  if (const TextNode* const nested = root.find("Camera"); nested != nullptr && nested->has("model"))
    return read_orb_slam(CameraKeys(*nested, file, "Camera."), keys, "");
  const CameraKeys::Names matrices{
      "camera_matrix", "Camera_Matrix", "cameraMatrix", "intrinsic_matrix", "K",  "k",
      "mtx",           "cam_K",         "M1",           "P_rect_02",        "P2", "P0"};
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
  if (const std::string prefix = only_prefix(keys); !prefix.empty()) return read_prefixed(keys, prefix);
  if (where.empty())
    for (const char* part : {"cam0", "color", "rgb", "camera", "Camera", "intrinsics", "intrinsic", "cam"})
      if (const TextNode* const node = root.find(part); node != nullptr && node->kind == TextNode::Kind::kMap)
        return read_camera_tree(*node, file, std::string(part) + ".");
  if (where.empty())
    for (const char* part : {"Dataset", "dataset", "sensor"})  // MonoGS and its like
      if (const TextNode* const node = root.find(part); node != nullptr)
        for (const char* inner : {"Calibration", "calibration", "intrinsics"})
          if (const TextNode* const found = node->find(inner);
              found != nullptr && found->kind == TextNode::Kind::kMap)
            return read_camera_tree(*found, file, std::string(part) + "." + inner + ".");
  if (where.empty())
    if (const TextNode* const section = only_camera_section(keys); section != nullptr)
      return read_camera_tree(*section, file, "below a section: ");
  std::string found;
  for (std::size_t i = 0; i < std::min<std::size_t>(root.keys.size(), 5); ++i)
    found += (i > 0 ? ", " : "") + root.keys[i];
  keys.fail(
      "no calibration of a known kind; expected Camera.fx, camera_matrix, cam0, intrinsics, fl_x or fx" +
      (found.empty() ? std::string() : ", found " + found));
}

}  // namespace detail
}  // namespace sslam
