// SPDX-License-Identifier: BSD-3-Clause
// Calibrations whose numbers each have a name: ORB-SLAM, stella_vslam, nerfstudio and instant-ngp, RealSense.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/core/closest_word.hpp"
#include "sslam/opencv/camera/lens_reader.hpp"

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

// "WIDTH, HEIGHT" of a list.
inline void set_size(const CameraKeys& keys, std::string_view key, CameraFile& file) {
  const std::vector<double> size = keys.numbers({key}, "the width and the height in pixels");
  if (size.empty()) return;
  if (size.size() != 2)
    keys.fail(keys.where() + std::string(key) + ": expected two numbers, the width and the height");
  const TextNode& node = *keys.map().find(key);
  file.camera.width = keys.whole_pixels(node, key, size[0]);
  file.camera.height = keys.whole_pixels(node, key, size[1]);
}

// The same under any of the names that it has beside a matrix or named numbers, where width and height have
// no keys of their own.
inline void set_size_pair(const CameraKeys& keys, CameraFile& file) {
  for (const std::string_view key :
       {"resolution", "image_size", "imageSize", "img_size", "image_dimension", "imageResolution"})
    if (const TextNode* const list = keys.map().find(key);
        file.camera.width == 0 && list != nullptr && list->kind == TextNode::Kind::kList)
      set_size(keys, key, file);
}

// fx and so on, each under `prefix`, and the coefficients by their names. Sets the size first: lenses are
// fitted within the image.
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
  const auto coefficient = [&](const char* key) { return keys.optional({named(key)}, 0, kCoefficient); };
  for (const char* key : {"xi", "omega", "alpha", "beta"})
    if (coefficient(key) != 0) refuse_lens(keys, "with the coefficient " + named(key));
  const bool fisheye = lens_model(model) == LensModel::kFisheye;
  if (fisheye && (coefficient("p1") != 0 || coefficient("p2") != 0))
    keys.fail(named("p1") + " belongs to a pinhole's lens, and '" + model +
              "' is a fisheye; expected k1 to k4 alone");
  if (!fisheye && keys.has(named("k4")) && !keys.has(named("p1")) && !keys.has(named("k5")) &&
      (coefficient("k3") != 0 || coefficient("k4") != 0))
    keys.fail(named("k4") + " without " + named("p1") + " belongs to a fisheye, and the model is '" + model +
              "'; expected k1 k2 p1 p2 k3, or the name of the fisheye model (KannalaBrandt8, fisheye)");
  std::vector<double> values;
  if (fisheye) {
    for (const char* key : {"k1", "k2", "k3", "k4"}) values.push_back(coefficient(key));
  } else {
    for (const char* key : {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"})
      values.push_back(coefficient(key));
  }
  set_lens(keys, model, values, file);
}

// "Camera1." of ORB-SLAM3's "Camera1.fx"; of several the lowest; empty: none. `count`: how many there are.
[[nodiscard]] inline std::string numbered_camera(const TextNode& map, int* count = nullptr) {
  std::string first;
  for (char digit = '0'; digit <= '9'; ++digit) {
    const std::string prefix = std::string("Camera") + digit + ".";
    if (!map.has(prefix + "fx")) continue;
    if (first.empty()) first = prefix;
    if (count != nullptr) ++*count;
  }
  return first;
}

// ORB-SLAM2 and 3, stella_vslam and OpenVSLAM: "Camera.fx" at the top, or fx in a map "Camera" (`prefix`
// empty).
inline CameraFile read_orb_slam(const CameraKeys& keys, const CameraKeys& top, const std::string& prefix) {
  CameraFile file;
  int cameras = 0;
  const std::string first = keys.has(prefix + "fx") ? std::string() : numbered_camera(keys.map(), &cameras);
  std::string model = keys.text({prefix + "model"});
  if (model.empty()) model = keys.text({prefix + "type"});
  const std::string width = prefix + "width", height = prefix + "height", columns = prefix + "cols",
                    rows = prefix + "rows", rate = prefix + "fps";
  file.camera.width = keys.optional_pixels({width, columns});
  file.camera.height = keys.optional_pixels({height, rows});
  read_named_pinhole(keys, first.empty() ? prefix : first, model.empty() ? "pinhole" : model, file);
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
  if (!first.empty()) note_unknown(keys, first, known, file);
  if (cameras > 1)
    file.notes.push_back(keys.file() + ": has several cameras; the first, " + first +
                         "fx and so on, is taken");
  return file;
}

// nerfstudio, instant-ngp, Record3D and Polycam. Their first pixel's centre is (0.5, 0.5).
inline CameraFile read_transforms(const CameraKeys& keys, const TextNode& root) {
  CameraFile file;
  file.camera.width = keys.optional_pixels({"w", "width"});
  file.camera.height = keys.optional_pixels({"h", "height"});
  if (keys.has_any({"fl_x", "fx"})) {
    std::string model = keys.text({"camera_model"});
    if (keys.text({"is_fisheye"}) == "true") model = "OPENCV_FISHEYE";
    read_named_pinhole(keys, "", model.empty() ? "OPENCV" : model, file);
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
  if (angle >= std::numbers::pi)
    keys.fail("camera_angle_x is " + short_text(angle) +
              "; expected the horizontal field of view in radians; are these degrees, give --fov " +
              short_text(angle) + " instead of this file");
  if (angle > 0) {
    file.view_across = angle;
    return file;
  }
  const TextNode* const frames = root.find("frames");
  if (&keys.map() == &root && frames != nullptr && !frames->items.empty()) {
    file = read_transforms(CameraKeys(frames->items.front(), keys.file(), "frames[0]."), root);
    double least = file.camera.pinhole.fx, most = least;
    for (const TextNode& frame : frames->items) {
      const double focal = CameraKeys(frame, keys.file(), "frames.").optional({"fl_x", "fx"}, least, kFocal);
      least = std::min(least, focal);
      most = std::max(most, focal);
    }
    constexpr double kSame = 1.01;
    file.notes.push_back(keys.file() + ": the camera is that of the first of its frames" +
                         (most > kSame * least ? "; their focal lengths go from " + short_text(least) +
                                                     " to " + short_text(most) + " pixels"
                                               : ""));
    return file;
  }
  keys.fail(keys.where() + "fl_x is missing; expected " + kFocal);
}

// The scene files of ScanNet, beside their recordings.
inline CameraFile read_scannet_scene(const CameraKeys& keys) {
  CameraFile file;
  file.camera.width = keys.optional_pixels({"colorWidth"});
  file.camera.height = keys.optional_pixels({"colorHeight"});
  file.camera.pinhole = {keys.required_positive({"fx_color"}, kFocal),
                         keys.required_positive({"fy_color"}, kFocal), keys.required({"mx_color"}, kCentre),
                         keys.required({"my_color"}, kCentre)};
  return file;
}

// fx, fy and cx, cy or ppx, ppy by these names: RealSense, Replica, NICE-SLAM, and others of their own.
inline CameraFile read_plain_names(const CameraKeys& keys) {
  CameraFile file;
  const std::vector<double> values = lens_list(keys);
  file.camera.width = keys.optional_pixels({"width", "w", "image_width", "W"});
  file.camera.height = keys.optional_pixels({"height", "h", "image_height", "H"});
  set_size_pair(keys, file);
  std::string model = keys.text({"model", "distortion_model", "camera_model", "type"});
  read_named_pinhole(keys, "", model.empty() || !values.empty() ? "pinhole" : model, file);
  if (!values.empty()) set_lens(keys, model.empty() ? "plumb_bob" : model, values, file);
  file.frame_rate = keys.optional_positive({"fps"}, "frames a second");
  file.depth_factor = keys.optional_positive({"scale", "png_depth_scale", "depth_factor"},
                                             "depth image units a metre");  // Replica, NICE-SLAM
  return file;
}

}  // namespace detail
}  // namespace sslam
