// SPDX-License-Identifier: BSD-3-Clause
// Calibrations in YAML and JSON, each as its program writes it: ORB-SLAM, stella_vslam, OpenCV, ROS, Kalibr,
// EuRoC and TUM-VI, nerfstudio and instant-ngp, RealSense, Open3D.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/core/closest_word.hpp"
#include "sslam/opencv/camera/camera_keys.hpp"
#include "sslam/opencv/camera/lens_words.hpp"

namespace sslam {
namespace detail {

inline constexpr const char* kFocal = "the focal length in pixels";
inline constexpr const char* kCentre = "the principal point in pixels";
inline constexpr const char* kCoefficient = "a distortion coefficient";

// Names those of the map's keys that start with `prefix` and were not read: a misspelt one changes the
// camera.
inline void note_unknown(const CameraKeys& keys, std::string_view prefix,
                         const std::vector<std::string>& known, CameraFile& file) {
  std::string unknown;
  for (const std::string& key : keys.map().keys) {
    if (!key.starts_with(prefix) ||
        std::find(known.begin(), known.end(), key.substr(prefix.size())) != known.end())
      continue;
    const std::string nearest = closest_word(key.substr(prefix.size()), known);
    unknown += (unknown.empty() ? "" : ", ") + keys.where() + key;
    if (!nearest.empty()) unknown += " (meant: " + std::string(prefix) + nearest + "?)";
  }
  if (!unknown.empty())
    file.notes.push_back(keys.file() + ": keys that are not known were left out: " + unknown);
}

// fx and so on, each under `prefix`, and the coefficients by their names.
inline void read_named_pinhole(const CameraKeys& keys, const std::string& prefix, const std::string& model,
                               CameraFile& file) {
  const auto named = [&prefix](const char* key) { return prefix + key; };
  const auto positive = [&](const std::string& key, const std::string& other) {
    return keys.required_positive({key, other}, kFocal);
  };
  Pinhole<double>& pinhole = file.camera.pinhole;
  pinhole.fx = positive(named("fx"), named("fl_x"));
  pinhole.fy = positive(named("fy"), named("fl_y"));
  const std::string cx = named("cx"), cy = named("cy"), ppx = named("ppx"), ppy = named("ppy");
  pinhole.cx = keys.required({cx, ppx}, kCentre);
  pinhole.cy = keys.required({cy, ppy}, kCentre);
  for (const char* key : {"xi", "omega", "alpha", "beta"})
    if (keys.has(named(key)) && keys.optional({named(key)}, 0, kCoefficient) != 0)
      refuse_lens(keys, "with the coefficient " + named(key));
  std::vector<double> values;
  for (const char* key : {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"})
    values.push_back(keys.optional({named(key)}, 0, kCoefficient));
  const bool fisheye_keys = keys.has(named("k4")) && !keys.has(named("p1")) && !keys.has(named("k5"));
  set_lens(keys, fisheye_keys && lens_model(model) != LensModel::kNone ? "fisheye (k1 to k4, no p1)" : model,
           values, file.camera.distortion);
}

// ORB-SLAM2 and 3, stella_vslam and OpenVSLAM: "Camera.fx" at the top, or fx in a map "Camera" (`prefix`
// empty).
inline CameraFile read_orb_slam(const CameraKeys& keys, const CameraKeys& top, const std::string& prefix) {
  CameraFile file;
  const bool numbered = !keys.has(prefix + "fx") && keys.has("Camera1.fx");
  std::string model = keys.text({prefix + "model"});
  if (model.empty()) model = keys.text({prefix + "type"});
  if (!model.empty() && lens_model(model) != LensModel::kRadTan && lens_model(model) != LensModel::kNone)
    refuse_lens(keys, model);
  read_named_pinhole(keys, numbered ? "Camera1." : prefix, model.empty() ? "pinhole" : model, file);
  const std::string width = prefix + "width", height = prefix + "height", columns = prefix + "cols",
                    rows = prefix + "rows", rate = prefix + "fps";
  file.camera.width = keys.optional_pixels({width, columns});
  file.camera.height = keys.optional_pixels({height, rows});
  file.frame_rate = keys.optional_positive({rate}, "frames a second");
  file.depth_factor = top.optional_positive({"DepthMapFactor", "RGBD.DepthMapFactor", "depthmap_factor"},
                                            "depth image units a metre");
  static const std::vector<std::string> known{"type",
                                              "model",
                                              "name",
                                              "setup",
                                              "fx",
                                              "fy",
                                              "cx",
                                              "cy",
                                              "k1",
                                              "k2",
                                              "k3",
                                              "p1",
                                              "p2",
                                              "k4",
                                              "k5",
                                              "k6",
                                              "width",
                                              "height",
                                              "cols",
                                              "rows",
                                              "fps",
                                              "RGB",
                                              "color_order",
                                              "bf",
                                              "newWidth",
                                              "newHeight",
                                              "imageScale",
                                              "focal_x_baseline",
                                              "depth_threshold",
                                              "depthmap_factor",
                                              "baseline",
                                              "ThDepth"};
  note_unknown(keys, prefix, known, file);
  if (numbered) note_unknown(keys, "Camera1.", known, file);
  return file;
}

// A 3x3 or 4x4 matrix, or KITTI's 3x4, by rows; by columns where it is so stored (Open3D).
inline void set_matrix(const CameraKeys& keys, std::string_view key, const std::vector<double>& m,
                       CameraFile& file) {
  const std::size_t n = m.size() == 9 ? 3 : 4;
  if (m.size() != 9 && m.size() != 12 && m.size() != 16)
    keys.fail(keys.where() + std::string(key) + " has " + std::to_string(m.size()) +
              " numbers; expected the 9 of a camera matrix: fx 0 cx 0 fy cy 0 0 1");
  const bool by_columns = m.size() == 9 && m[2] == 0 && m[5] == 0 && (m[6] != 0 || m[7] != 0);
  file.camera.pinhole = {m[0], m[n + 1], by_columns ? m[6] : m[2], by_columns ? m[7] : m[n + 2]};
  const Pinhole<double>& p = file.camera.pinhole;
  const bool skewed = m[n] != 0 || m[1] != 0, whole = m[2 * n + 2] == 1;
  if (!(p.fx > 0) || !(p.fy > 0) || skewed || !whole)
    keys.fail(keys.where() + std::string(key) +
              " is no camera matrix; expected fx 0 cx 0 fy cy 0 0 1, with fx and fy greater than 0");
}

// OpenCV's FileStorage and the samples that write it; ROS camera_info as a file or as a message; Open3D.
inline CameraFile read_matrix_camera(const CameraKeys& keys, const CameraKeys::Names& matrix) {
  CameraFile file;
  set_matrix(keys, matrix.front(), keys.numbers(matrix, "a camera matrix"), file);
  const CameraKeys::Names lens{"distortion_coefficients",
                               "Distortion_Coefficients",
                               "distortion_coeffs",
                               "distCoeffs",
                               "dist_coeffs",
                               "distortion",
                               "dist",
                               "D",
                               "d"};
  std::string model = keys.text({"distortion_model", "model"});
  if (keys.optional({"fisheye_model", "Fisheye"}, 0, "0 or 1") != 0) model = "fisheye";
  const std::vector<double> values = keys.numbers(lens, "distortion coefficients");
  if (model.empty() && values.size() > 5) model = "rational";
  set_lens(keys, model.empty() ? "plumb_bob" : model, values, file.camera.distortion);
  file.camera.width = keys.optional_pixels({"image_width", "image_Width", "width", "w"});
  file.camera.height = keys.optional_pixels({"image_height", "image_Height", "height", "h"});
  return file;
}

// Kalibr's cam0, and the sensor.yaml of EuRoC, TUM-VI and ASL.
inline CameraFile read_kalibr(const CameraKeys& keys) {
  CameraFile file;
  const std::string camera = keys.text({"camera_model"});
  if (!camera.empty() && plain_word(camera) != "pinhole") refuse_lens(keys, camera);
  const std::vector<double> values = keys.numbers({"intrinsics"}, "fx fy cx cy");
  if (values.size() != 4 || !(values[0] > 0) || !(values[1] > 0))
    keys.fail(keys.where() + "intrinsics: expected the four numbers fx fy cx cy, fx and fy greater than 0");
  file.camera.pinhole = {values[0], values[1], values[2], values[3]};
  set_lens(keys, keys.text({"distortion_model"}),
           keys.numbers({"distortion_coeffs", "distortion_coefficients"}, "distortion coefficients"),
           file.camera.distortion);
  const std::vector<double> size = keys.numbers({"resolution"}, "the width and the height in pixels");
  if (size.size() == 2) {
    const TextNode& node = *keys.map().find("resolution");
    file.camera.width = keys.whole_pixels(node, "resolution", size[0]);
    file.camera.height = keys.whole_pixels(node, "resolution", size[1]);
  } else if (!size.empty()) {
    keys.fail(keys.where() + "resolution: expected two numbers, the width and the height in pixels");
  }
  file.frame_rate = keys.optional_positive({"rate_hz"}, "frames a second");
  static const std::vector<std::string> known{
      "camera_model", "intrinsics", "distortion_model", "distortion_coeffs", "distortion_coefficients",
      "resolution",   "rate_hz",    "cam_overlaps",     "rostopic",          "timeshift_cam_imu",
      "T_cam_imu",    "T_cn_cnm1",  "sensor_type",      "comment",           "T_BS",
      "line-delay",   "line_delay", "T_imu_cam"};
  note_unknown(keys, "", known, file);
  return file;
}

// nerfstudio, instant-ngp, Record3D and Polycam. Their first pixel's centre is (0.5, 0.5).
inline CameraFile read_transforms(const CameraKeys& keys, const TextNode& root) {
  CameraFile file;
  file.camera.width = keys.optional_pixels({"w", "width"});
  file.camera.height = keys.optional_pixels({"h", "height"});
  if (keys.has_any({"fl_x", "fx"})) {
    read_named_pinhole(keys, "", keys.text({"camera_model"}).empty() ? "OPENCV" : keys.text({"camera_model"}),
                       file);
    file.camera.pinhole.cx -= 0.5;
    file.camera.pinhole.cy -= 0.5;
    return file;
  }
  const double angle = keys.optional_positive({"camera_angle_x"}, "the horizontal field of view in radians");
  if (angle > 0 && angle < std::numbers::pi && file.camera.width > 0 && file.camera.height > 0) {
    const double focal = file.camera.width / 2.0 / std::tan(angle / 2);
    file.camera.pinhole = {focal, focal, 0.5 * (file.camera.width - 1), 0.5 * (file.camera.height - 1)};
    return file;
  }
  if (angle > 0)
    keys.fail("camera_angle_x without w and h; give --fov " + short_text(angle * 180 / std::numbers::pi) +
              " instead of this file");
  const TextNode* const frames = root.find("frames");
  if (&keys.map() == &root && frames != nullptr && !frames->items.empty()) {
    file = read_transforms(CameraKeys(frames->items.front(), keys.file(), "frames[0]."), root);
    file.notes.push_back(keys.file() + ": the camera is that of the first of its frames");
    return file;
  }
  keys.fail(keys.where() + "fl_x is missing; expected " + kFocal);
}

// fx, fy and cx, cy or ppx, ppy by these names: RealSense, and others of their own.
inline CameraFile read_plain_names(const CameraKeys& keys) {
  CameraFile file;
  const std::vector<double> values =
      keys.numbers({"coeffs", "coefficients", "distortion_coeffs", "distortion"}, "distortion coefficients");
  std::string model = keys.text({"model", "distortion_model", "camera_model", "type"});
  read_named_pinhole(keys, "", model.empty() || !values.empty() ? "pinhole" : model, file);
  if (!values.empty()) set_lens(keys, model.empty() ? "plumb_bob" : model, values, file.camera.distortion);
  file.camera.width = keys.optional_pixels({"width", "w", "image_width"});
  file.camera.height = keys.optional_pixels({"height", "h", "image_height"});
  file.frame_rate = keys.optional_positive({"fps"}, "frames a second");
  return file;
}

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
  if (keys.has("intrinsics") && keys.has_any({"resolution", "camera_model", "distortion_model"}))
    return read_kalibr(keys);
  if (keys.has_any({"fl_x", "camera_angle_x"}) || (keys.has("frames") && where.empty()))
    return read_transforms(keys, root);
  if (keys.has("fx")) return read_plain_names(keys);
  if (where.empty())
    for (const char* part : {"cam0", "color", "rgb", "camera", "intrinsics", "cam"})
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
