// SPDX-License-Identifier: BSD-3-Clause
// Calibrations of photogrammetry programs: OpenSfM and OpenDroneMap, Meshroom (AliceVision), OpenMVG.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "sslam/opencv/camera/slam_cameras.hpp"

namespace sslam {
namespace detail {

// OpenSfM names its cameras; a camera tells its projection.
[[nodiscard]] inline bool is_opensfm(const TextNode& root) {
  return !root.items.empty() && root.kind == TextNode::Kind::kMap &&
         root.items.front().has("projection_type");
}

// Lengths are parts of the image's longer side, counted from its middle.
inline CameraFile read_opensfm(const CameraKeys& top) {
  const CameraKeys keys(top.map().items.front(), top.file(), top.map().keys.front() + ": ");
  CameraFile file;
  file.camera.width = keys.optional_pixels({"width"});
  file.camera.height = keys.optional_pixels({"height"});
  const double side = std::max(file.camera.width, file.camera.height);
  if (file.camera.width == 0 || file.camera.height == 0)
    keys.fail(keys.where() + "width and height are missing; expected the size of the images");
  const std::string focal = "the focal length as a part of the image's longer side";
  const double fx = keys.required_positive({"focal_x", "focal"}, focal);
  const double fy = keys.required_positive({"focal_y", "focal_x", "focal"}, focal);
  file.camera.pinhole = {fx * side, fy * side,
                         keys.optional({"c_x"}, 0, kCentre) * side + 0.5 * (file.camera.width - 1),
                         keys.optional({"c_y"}, 0, kCentre) * side + 0.5 * (file.camera.height - 1)};
  const std::string type = keys.text({"projection_type"});
  if (type == "fisheye" || type == "fisheye_opencv")
    set_lens(keys, "fisheye", named_values(keys, {"k1", "k2", "k3", "k4"}), file);
  else if (type == "perspective" || type == "simple_radial" || type == "radial" || type == "brown")
    set_lens(keys, "radtan", named_values(keys, {"k1", "k2", "p1", "p2", "k3"}), file);
  else
    refuse_lens(keys, type);
  note_first_of(top, top.map().items.size(), file);
  return file;
}

// The lens of Meshroom and OpenMVG, in the order of radial coefficients, then tangential ones.
inline void set_radial_list(const CameraKeys& keys, const std::string& model,
                            const std::vector<double>& values, CameraFile& file) {
  const std::string word = plain_word(model);
  const auto ends = [&word](std::string_view end) { return word.ends_with(end); };
  const bool straight = std::all_of(values.begin(), values.end(), [](double value) { return value == 0; });
  if (straight && word.find("fisheye") == std::string::npos && word.find("equi") == std::string::npos) return;
  if (values.size() == 4 && (word == "fisheye" || word == "fisheye4" || word == "equidistant4"))
    return set_lens(keys, "fisheye", values, file);
  const bool radial = ends("radialk1") || ends("radialk3") || word == "radial1" || word == "radial3";
  const bool brown = ends("brown") || ends("brownt2") || ends("brownk3t2");
  if ((!radial && !brown) || values.size() > 5) refuse_lens(keys, model);
  std::vector<double> k = values;
  k.resize(5);
  set_lens(keys, "radtan", {k[0], k[1], k[3], k[4], k[2]}, file);
}

// A principal point as such, or as its distance from the middle of the image.
[[nodiscard]] inline double from_middle(double value, int pixels) noexcept {
  return std::abs(value) < 0.25 * pixels ? value + 0.5 * pixels : value;
}

inline CameraFile read_meshroom(const CameraKeys& keys) {
  CameraFile file;
  file.camera.width = keys.optional_pixels({"width"});
  file.camera.height = keys.optional_pixels({"height"});
  double focal = keys.optional_positive({"pxFocalLength"}, kFocal);
  if (focal == 0) {
    const double sensor = keys.required_positive({"sensorWidth"}, "the sensor's width in millimetres");
    focal = keys.required_positive({"focalLength"}, "the focal length in millimetres") / sensor *
            file.camera.width;
  }
  const std::vector<double> centre = keys.numbers({"principalPoint"}, kCentre);
  if (centre.size() != 2 || file.camera.width == 0 || file.camera.height == 0)
    keys.fail(keys.where() + "principalPoint, width and height: expected two numbers, and the images' size");
  file.camera.pinhole = {focal, focal, from_middle(centre[0], file.camera.width),
                         from_middle(centre[1], file.camera.height)};
  std::string model = keys.text({"distortionType"});
  if (model.empty()) model = keys.text({"type"});
  set_radial_list(keys, model, keys.numbers({"distortionParams", "distortionCoefficients"}, kCoefficient),
                  file);
  return file;
}

inline CameraFile read_openmvg(const CameraKeys& top) {
  const CameraKeys value = map_under(top, "value");
  const CameraKeys keys = map_under(map_under(value, "ptr_wrapper"), "data");
  CameraFile file;
  file.camera.width = keys.optional_pixels({"width"});
  file.camera.height = keys.optional_pixels({"height"});
  const double focal = keys.required_positive({"focal_length"}, kFocal);
  const std::vector<double> centre = keys.numbers({"principal_point"}, kCentre);
  if (centre.size() != 2) keys.fail(keys.where() + "principal_point: expected two numbers, in pixels");
  file.camera.pinhole = {focal, focal, centre[0], centre[1]};
  set_radial_list(value, value.text({"polymorphic_name"}),
                  keys.numbers({"disto_k1", "disto_k3", "disto_t2", "fisheye"}, kCoefficient), file);
  return file;
}

// Whether the intrinsics are a list of cameras, each a map of its own.
[[nodiscard]] inline bool lists_cameras(const TextNode& root) {
  const TextNode* const list = root.find("intrinsics");
  return list != nullptr && list->kind == TextNode::Kind::kList && !list->items.empty() &&
         list->items.front().kind == TextNode::Kind::kMap;
}

inline CameraFile read_listed_cameras(const CameraKeys& top) {
  const TextNode& list = *top.map().find("intrinsics");
  const CameraKeys keys(list.items.front(), top.file(), "intrinsics[0].");
  CameraFile file = keys.has("value") ? read_openmvg(keys) : read_meshroom(keys);
  note_first_of(top, list.items.size(), file);
  return file;
}

}  // namespace detail
}  // namespace sslam
