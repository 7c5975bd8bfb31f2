// SPDX-License-Identifier: BSD-3-Clause
// Calibrations in YAML, JSON and XML: tells by the keys which program wrote them.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/opencv/camera/depthai_cameras.hpp"
#include "sslam/opencv/camera/matrix_cameras.hpp"
#include "sslam/opencv/camera/named_cameras.hpp"
#include "sslam/opencv/camera/photo_cameras.hpp"
#include "sslam/opencv/camera/sensor_cameras.hpp"
#include "sslam/opencv/camera/slam_cameras.hpp"

namespace sslam {
namespace detail {

// A map within others that holds a camera, and the keys that lead to it.
struct CameraSection {
  const TextNode* map = nullptr;
  std::string path;
};

[[nodiscard]] inline bool holds_camera(const TextNode& map) {
  const TextNode* const list = map.find("intrinsics");
  return (map.has("fx") && (map.has("cx") || map.has("ppx"))) || map.has("camera_matrix") ||
         (list != nullptr && list->kind == TextNode::Kind::kList && !list->items.empty());
}

// Adds the sections below a map or a list, as long as there are few.
inline void find_camera_sections(const TextNode& node, const std::string& path, int deep,
                                 std::vector<CameraSection>& found) {
  constexpr std::size_t kMost = 8;  // to name
  for (std::size_t i = 0; i < node.items.size() && deep > 0 && found.size() < kMost; ++i) {
    const std::string own = node.keys.empty() ? "[" + std::to_string(i) + "]"
                            : path.empty()    ? node.keys[i]
                                              : "." + node.keys[i];
    if (holds_camera(node.items[i]))
      found.push_back({&node.items[i], path + own});
    else
      find_camera_sections(node.items[i], path + own, deep - 1, found);
  }
}

// The only one; null: none. Throws Error where there are several.
[[nodiscard]] inline CameraSection only_camera_section(const CameraKeys& keys) {
  constexpr int kDeep = 4;
  std::vector<CameraSection> found;
  find_camera_sections(keys.map(), {}, kDeep, found);
  if (found.size() < 2) return found.empty() ? CameraSection{} : found.front();
  std::string names;
  for (const CameraSection& section : found) names += (names.empty() ? "" : ", ") + section.path;
  keys.fail("has several cameras: " + names + "; expected one: keep that of the images alone");
}

// The same with small letters in all keys, as in FX or Camera_Matrix.
[[nodiscard]] inline TextNode with_small_keys(TextNode tree) {
  for (std::string& key : tree.keys)
    for (char& c : key) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (TextNode& item : tree.items) item = with_small_keys(std::move(item));
  return tree;
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

// Square pixels: one focal length.
[[nodiscard]] inline CameraFile read_one_focal(TextNode tree, const CameraKeys& keys) {
  for (const char* name : {"fx", "fy"}) {
    tree.keys.emplace_back(name);
    tree.items.push_back(*keys.map().find("f"));
  }
  return read_plain_names(CameraKeys(tree, keys.file(), keys.where()));
}

// Of Kalibr's cam0, cam1 and so on the first is taken.
[[nodiscard]] inline CameraFile noting_others(const TextNode& root, std::string_view part, CameraFile file,
                                              const CameraKeys& keys) {
  const auto more = std::count_if(root.keys.begin(), root.keys.end(), [part](const std::string& key) {
    return key.size() == part.size() && key != part && key.starts_with("cam") &&
           key.find_last_not_of("0123456789") == 2;
  });
  if (more > 0)
    file.notes.push_back(keys.file() + ": has " + std::to_string(more + 1) + " cameras; " +
                         std::string(part) + " is taken");
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
  const CameraKeys::Names matrices{"camera_matrix",
                                   "Camera_Matrix",
                                   "cameraMatrix",
                                   "intrinsic_matrix",
                                   "K",
                                   "k",
                                   "mtx",
                                   "cam_K",
                                   "M1",
                                   "P_rect_02",
                                   "P2",
                                   "P0",
                                   "cameraIntrinsics",
                                   "intrinsicMatrix"};
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
  if (keys.has("focal_length") && keys.has("principal_point")) return read_pairs(keys);
  if (keys.has("f") && keys.has("cx")) return read_one_focal(root, keys);
  if (const std::string prefix = only_prefix(keys); !prefix.empty()) return read_prefixed(keys, prefix);
  if (where.empty())
    for (const char* part : {"cam0", "color", "rgb", "camera", "Camera", "intrinsics", "intrinsic", "cam"})
      if (const TextNode* const node = root.find(part); node != nullptr && node->kind == TextNode::Kind::kMap)
        return noting_others(root, part, read_camera_tree(*node, file, std::string(part) + "."), keys);
  if (where.empty())
    for (const char* part : {"Dataset", "dataset", "sensor"})  // MonoGS and its like
      if (const TextNode* const node = root.find(part); node != nullptr)
        for (const char* inner : {"Calibration", "calibration", "intrinsics"})
          if (const TextNode* const found = node->find(inner);
              found != nullptr && found->kind == TextNode::Kind::kMap)
            return read_camera_tree(*found, file, std::string(part) + "." + inner + ".");
  if (where.empty())
    if (const CameraSection section = only_camera_section(keys); section.map != nullptr)
      return read_camera_tree(*section.map, file, section.path + ".");
  if (TextNode small = with_small_keys(root); where.empty() && small.keys != root.keys && holds_camera(small))
    return read_camera_tree(small, file);
  std::string found;
  for (std::size_t i = 0; i < std::min<std::size_t>(root.keys.size(), 5); ++i)
    found += (i > 0 ? ", " : "") + root.keys[i];
  keys.fail(
      "no calibration of a known kind; expected Camera.fx, camera_matrix, cam0, intrinsics, fl_x or fx" +
      (found.empty() ? std::string() : ", found " + found));
}

}  // namespace detail
}  // namespace sslam
