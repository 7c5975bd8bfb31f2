// SPDX-License-Identifier: BSD-3-Clause
// Calibrations of other SLAM systems whose numbers stand in maps of their own: VINS-Mono and VINS-Fusion,
// OKVIS, Basalt.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/opencv/camera/matrix_cameras.hpp"

namespace sslam {
namespace detail {

// The map under a key. Throws Error where there is none.
[[nodiscard]] inline CameraKeys map_under(const CameraKeys& keys, std::string_view key) {
  const TextNode* const node = keys.map().find(key);
  if (node == nullptr || node->kind != TextNode::Kind::kMap)
    keys.fail(keys.where() + std::string(key) + " is missing; expected the numbers of the camera below it");
  return {*node, keys.file(), keys.where() + std::string(key) + "."};
}

[[nodiscard]] inline std::vector<double> named_values(const CameraKeys& keys,
                                                      const std::vector<std::string_view>& names) {
  std::vector<double> values;
  values.reserve(names.size());
  for (const std::string_view name : names) values.push_back(keys.optional({name}, 0, kCoefficient));
  return values;
}

[[nodiscard]] inline Pinhole<double> named_plane(const CameraKeys& keys, std::string_view fx,
                                                 std::string_view fy, std::string_view cx,
                                                 std::string_view cy) {
  return {keys.required_positive({fx}, kFocal), keys.required_positive({fy}, kFocal),
          keys.required({cx}, kCentre), keys.required({cy}, kCentre)};
}

inline void note_first_of(const CameraKeys& keys, std::size_t count, CameraFile& file) {
  if (count > 1)
    file.notes.push_back(keys.file() + ": has " + std::to_string(count) + " cameras; the first is taken");
}

// VINS-Mono and VINS-Fusion write the files of camodocal.
inline CameraFile read_vins(const CameraKeys& keys) {
  CameraFile file;
  file.camera.width = keys.optional_pixels({"image_width"});
  file.camera.height = keys.optional_pixels({"image_height"});
  const std::string model = keys.text({"model_type"});
  const std::string word = plain_word(model);
  const CameraKeys plane = map_under(keys, "projection_parameters");
  if (word == "kannalabrandt") {
    file.camera.pinhole = named_plane(plane, "mu", "mv", "u0", "v0");
    set_lens(keys, "fisheye", named_values(plane, {"k2", "k3", "k4", "k5"}), file);
    return file;
  }
  const bool omni = word == "mei";
  if (!omni && word != "pinhole" && word != "pinholefull") refuse_lens(keys, model);
  file.camera.pinhole =
      omni ? named_plane(plane, "gamma1", "gamma2", "u0", "v0") : named_plane(plane, "fx", "fy", "cx", "cy");
  std::vector<double> lens = named_values(map_under(keys, "distortion_parameters"),
                                          {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"});
  if (!omni) {
    set_lens(keys, "radtan", lens, file);
    return file;
  }
  const double xi = map_under(keys, "mirror_parameters").required({"xi"}, "the number of the mirror");
  if (!(xi >= 0)) keys.fail("mirror_parameters.xi is " + short_text(xi) + "; expected 0 or more");
  lens.insert(lens.begin(), xi);
  set_wide_lens(keys, WideModel::kOmni, leading<5>(keys, model, lens),
                "the lens model '" + model + "' is no pinhole's; " + kWayOut, file);
  return file;
}

// A configuration of VINS names the files of its cameras.
[[noreturn]] inline void refuse_vins_settings(const CameraKeys& keys) {
  keys.fail("holds the settings of VINS-Fusion, not a camera; its camera file is " +
            keys.text({"cam0_calib"}) + ", beside it");
}

// focal_length and principal_point, two numbers each.
inline CameraFile read_pairs(const CameraKeys& keys) {
  CameraFile file;
  const std::vector<double> focal = keys.numbers({"focal_length"}, kFocal);
  const std::vector<double> centre = keys.numbers({"principal_point"}, kCentre);
  if (focal.size() != 2 || centre.size() != 2 || !(focal[0] > 0) || !(focal[1] > 0))
    keys.fail(keys.where() + "focal_length and principal_point: expected two numbers each, in pixels");
  file.camera.pinhole = {focal[0], focal[1], centre[0], centre[1]};
  set_size_pair(keys, file);
  const std::string model = keys.text({"distortion_type", "distortion_model"});
  set_lens(keys, model == "radialtangential8" ? "rational" : model, lens_list(keys), file);
  return file;
}

inline CameraFile read_okvis(const CameraKeys& top) {
  const TextNode& cameras = *top.map().find("cameras");
  CameraFile file = read_pairs(CameraKeys(cameras.items.front(), top.file(), "cameras[0]."));
  note_first_of(top, cameras.items.size(), file);
  return file;
}

// The camera rigs of SVO and of ETH's vio tools: cameras[0].camera.
[[nodiscard]] inline bool is_svo(const TextNode& root) {
  const TextNode* const list = root.find("cameras");
  return list != nullptr && list->kind == TextNode::Kind::kList && !list->items.empty() &&
         list->items.front().has("camera");
}

inline CameraFile read_svo(const CameraKeys& top) {
  const TextNode& list = *top.map().find("cameras");
  const CameraKeys keys = map_under(CameraKeys(list.items.front(), top.file(), "cameras[0]."), "camera");
  CameraFile file;
  file.camera.width = keys.optional_pixels({"image_width"});
  file.camera.height = keys.optional_pixels({"image_height"});
  const std::string type = keys.text({"type"});
  const std::vector<double> plane = keys.numbers({"intrinsics"}, "fx fy cx cy");
  if (plain_word(type) != "pinhole") refuse_lens(keys, type);
  if (plane.size() != 4 || !(plane[0] > 0) || !(plane[1] > 0))
    keys.fail(keys.where() + "intrinsics: expected the four numbers fx fy cx cy, fx and fy greater than 0");
  file.camera.pinhole = {plane[0], plane[1], plane[2], plane[3]};
  if (keys.has("distortion")) {
    const CameraKeys lens = map_under(keys, "distortion");
    set_lens(lens, lens.text({"type"}), lens.numbers({"parameters"}, "distortion coefficients"), file);
  }
  note_first_of(top, list.items.size(), file);
  return file;
}

inline CameraFile read_basalt(const CameraKeys& top) {
  const CameraKeys all = map_under(top, "value0");
  const TextNode* const cameras = all.map().find("intrinsics");
  if (cameras == nullptr || cameras->kind != TextNode::Kind::kList || cameras->items.empty())
    all.fail(all.where() + "intrinsics is missing; expected a list of cameras, as Basalt writes it");
  const CameraKeys keys(cameras->items.front(), top.file(), all.where() + "intrinsics[0].");
  CameraFile file;
  if (const TextNode* const sizes = all.map().find("resolution"); sizes != nullptr && !sizes->items.empty()) {
    TextNode first;
    first.kind = TextNode::Kind::kMap;
    first.keys = {"resolution"};
    first.items = {sizes->items.front()};
    set_size(CameraKeys(first, top.file(), all.where()), "resolution", file);
  }
  const CameraKeys plane = map_under(keys, "intrinsics");
  file.camera.pinhole = named_plane(plane, "fx", "fy", "cx", "cy");
  const std::string type = keys.text({"camera_type"}), word = plain_word(type);
  if (word == "pinhole") {
    // no distortion
  } else if (word == "kb4") {
    set_lens(keys, "fisheye", named_values(plane, {"k1", "k2", "k3", "k4"}), file);
  } else if (word == "pinholeradtan8") {
    set_lens(keys, "rational", named_values(plane, {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"}), file);
  } else if (word == "ds" || word == "eucm") {
    const std::vector<double> k =
        word == "ds" ? named_values(plane, {"xi", "alpha"}) : named_values(plane, {"alpha", "beta"});
    set_wide_lens(keys, word == "ds" ? WideModel::kDoubleSphere : WideModel::kUnified,
                  leading<5>(keys, type, k), "the lens model '" + type + "' is no pinhole's; " + kWayOut,
                  file);
  } else {
    refuse_lens(keys, type);
  }
  note_first_of(top, cameras->items.size(), file);
  return file;
}

}  // namespace detail
}  // namespace sslam
