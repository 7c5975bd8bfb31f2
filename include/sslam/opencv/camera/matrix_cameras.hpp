// SPDX-License-Identifier: BSD-3-Clause
// Calibrations as matrices and lists of numbers: OpenCV, ROS, Open3D, KITTI, Kalibr, EuRoC and TUM-VI.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sslam/opencv/camera/named_cameras.hpp"

namespace sslam {
namespace detail {

// A 3x3 or 4x4 matrix, or KITTI's 3x4, by rows; by columns where it is so stored (Open3D).
inline void set_matrix(const CameraKeys& keys, std::string_view key, const std::vector<double>& m,
                       CameraFile& file) {
  const std::size_t n = m.size() == 9 ? 3 : 4;
  if (m.size() != 9 && m.size() != 12 && m.size() != 16)
    keys.fail(keys.where() + std::string(key) + " has " + std::to_string(m.size()) +
              " numbers; expected the 9 of a camera matrix: fx 0 cx 0 fy cy 0 0 1");
  if (std::all_of(m.begin(), m.end(), [](double value) { return value == 0; }))
    keys.fail(keys.where() + std::string(key) +
              " is all 0, as of a camera that was never calibrated; expected fx 0 cx 0 fy cy 0 0 1");
  const bool by_columns = m.size() == 9 && m[2] == 0 && m[5] == 0 && (m[6] != 0 || m[7] != 0);
  file.camera.pinhole = {m[0], m[n + 1], by_columns ? m[6] : m[2], by_columns ? m[7] : m[n + 2]};
  const Pinhole<double>& p = file.camera.pinhole;
  const bool skewed = m[n] != 0 || m[1] != 0, whole = m[2 * n + 2] == 1;
  if (!(p.fx > 0) || !(p.fy > 0) || skewed || !whole)
    keys.fail(keys.where() + std::string(key) +
              " is no camera matrix; expected fx 0 cx 0 fy cy 0 0 1, with fx and fy greater than 0");
}

// ROS: the images are a region of the sensor, whose size and camera the other numbers are.
inline void take_region(const CameraKeys& keys, CameraFile& file) {
  const TextNode* const map = keys.map().find("roi");
  if (map == nullptr || map->kind != TextNode::Kind::kMap) return;
  const CameraKeys roi(*map, keys.file(), keys.where() + "roi.");
  const auto pixels = [&roi](std::string_view key) {
    return roi.optional({key}, 0, "a whole number of pixels");
  };
  const double width = pixels("width"), height = pixels("height");
  if (!(width > 0) || !(height > 0) || (width == file.camera.width && height == file.camera.height)) return;
  file.camera.width = roi.whole_pixels(*map, "width", width);
  file.camera.height = roi.whole_pixels(*map, "height", height);
  file.camera.pinhole.cx -= pixels("x_offset");
  file.camera.pinhole.cy -= pixels("y_offset");
  file.notes.push_back(keys.file() + ": the camera is that of its region of interest (roi), " +
                       std::to_string(file.camera.width) + "x" + std::to_string(file.camera.height));
}

// OpenCV's FileStorage and the samples that write it; ROS camera_info as a file or as a message; Open3D.
inline CameraFile read_matrix_camera(const CameraKeys& keys, const CameraKeys::Names& matrix) {
  CameraFile file;
  set_matrix(keys, matrix.front(), keys.numbers(matrix, "a camera matrix"), file);
  file.camera.width = keys.optional_pixels({"image_width", "image_Width", "width", "w"});
  file.camera.height = keys.optional_pixels({"image_height", "image_Height", "height", "h"});
  set_size_pair(keys, file);
  take_region(keys, file);
  std::string model = keys.text({"distortion_model", "model"});
  if (keys.optional({"fisheye_model", "Fisheye"}, 0, "0 or 1") != 0) model = "fisheye";
  std::vector<double> values =
      keys.has("M1") ? keys.numbers({"D1"}, "distortion coefficients") : lens_list(keys);
  const CameraKeys::Names named = lens_model(model) == LensModel::kFisheye
                                      ? CameraKeys::Names{"k1", "k2", "k3", "k4"}
                                      : CameraKeys::Names{"k1", "k2", "p1", "p2", "k3"};
  if (values.empty() && keys.has_any(named))
    for (const std::string_view key : named) values.push_back(keys.optional({key}, 0, kCoefficient));
  if (model.empty() && values.size() > 5) model = "rational";
  if (keys.has("M1") && keys.has("M2"))
    file.notes.push_back(keys.file() + ": has two cameras; the first, M1 and D1, is taken");
  set_lens(keys, model.empty() ? "plumb_bob" : model, values, file);
  return file;
}

// The fisheye profiles of Gyroflow, for action cameras.
inline CameraFile read_gyroflow(const CameraKeys& top) {
  CameraFile file;
  const TextNode* const size = top.map().find("calib_dimension");
  if (size != nullptr && size->kind == TextNode::Kind::kMap) {
    const CameraKeys keys(*size, top.file(), "calib_dimension.");
    file.camera.width = keys.optional_pixels({"w"});
    file.camera.height = keys.optional_pixels({"h"});
  }
  const CameraKeys keys(*top.map().find("fisheye_params"), top.file(), "fisheye_params.");
  set_matrix(keys, "camera_matrix", keys.numbers({"camera_matrix"}, "a camera matrix"), file);
  const std::string model = top.text({"distortion_model"});
  if (!model.empty() && plain_word(model) != "opencvfisheye" && plain_word(model) != "fisheye")
    refuse_lens(top, model);
  set_lens(keys, "fisheye", lens_list(keys), file);
  file.frame_rate = top.optional_positive({"fps"}, "frames a second");
  return file;
}

// mrcal's .cameramodel: the numbers of the lens follow fx fy cx cy, in OpenCV's order.
inline CameraFile read_mrcal(const CameraKeys& keys) {
  CameraFile file;
  const std::string model = keys.text({"lensmodel"});
  const std::vector<double> values = keys.numbers({"intrinsics"}, "fx fy cx cy and the lens");
  const std::vector<double> size = keys.numbers({"imagersize"}, "the width and the height in pixels");
  if (model != "LENSMODEL_PINHOLE" && !model.starts_with("LENSMODEL_OPENCV")) refuse_lens(keys, model);
  if (values.size() < 4 || !(values[0] > 0) || !(values[1] > 0) || size.size() != 2)
    keys.fail("intrinsics and imagersize: expected fx fy cx cy and the lens, and the width and the height");
  const TextNode& node = *keys.map().find("imagersize");
  file.camera.width = keys.whole_pixels(node, "imagersize", size[0]);
  file.camera.height = keys.whole_pixels(node, "imagersize", size[1]);
  file.camera.pinhole = {values[0], values[1], values[2], values[3]};
  set_lens(keys, "rational", {values.begin() + 4, values.end()}, file);
  return file;
}

inline void set_kalibr_wide_lens(const CameraKeys& keys, const std::string& name, LensModel model,
                                 const std::vector<double>& intrinsics, CameraFile& file) {
  std::vector<double> k(intrinsics.begin(),
                        intrinsics.begin() + static_cast<std::ptrdiff_t>(count_before_focal(model)));
  const std::vector<double> lens = lens_list(keys);
  const LensModel plane = lens_model(keys.text({"distortion_model"}));
  const bool straight = std::all_of(lens.begin(), lens.end(), [](double value) { return value == 0; });
  if (!straight && (model != LensModel::kOmni || plane != LensModel::kRadTan))
    keys.fail(keys.where() + "distortion_coeffs: expected none, or radtan's with the model omni");
  if (model == LensModel::kOmni) k.insert(k.end(), lens.begin(), lens.end());
  if (model == LensModel::kDoubleSphere ? !(k[0] > -1 && k[0] < 1 && k[1] >= 0 && k[1] <= 1)
      : model == LensModel::kUnified    ? !(k[0] >= 0 && k[0] <= 1 && k[1] > 0)
                                        : !(k[0] >= 0))
    keys.fail(keys.where() + "intrinsics: the first numbers are none of the model '" + name +
              "'; expected omni: xi fx fy cx cy; ds: xi alpha fx fy cx cy; eucm: alpha beta fx fy cx cy");
  set_wide_lens(keys,
                model == LensModel::kOmni           ? WideModel::kOmni
                : model == LensModel::kDoubleSphere ? WideModel::kDoubleSphere
                                                    : WideModel::kUnified,
                leading<5>(keys, name, k), "the lens model '" + name + "' is no pinhole's; " + kWayOut, file);
}

// Kalibr's cam0, and the sensor.yaml of EuRoC, TUM-VI and ASL.
inline CameraFile read_kalibr(const CameraKeys& keys) {
  CameraFile file;
  const std::string camera = keys.text({"camera_model"});
  const LensModel model = lens_model(camera);
  const std::size_t first = count_before_focal(model);
  if (first == 0 && !camera.empty() && plain_word(camera) != "pinhole") refuse_lens(keys, camera);
  const std::vector<double> values = keys.numbers({"intrinsics"}, "fx fy cx cy");
  if (first == 0 && (values.size() != 4 || !(values[0] > 0) || !(values[1] > 0)))
    keys.fail(keys.where() + "intrinsics: expected the four numbers fx fy cx cy, fx and fy greater than 0");
  if (values.size() != first + 4 || !(values[first] > 0) || !(values[first + 1] > 0))
    keys.fail(keys.where() + "intrinsics: expected " + std::to_string(first) + " numbers of the model '" +
              camera + "' and then fx fy cx cy, fx and fy greater than 0");
  file.camera.pinhole = {values[first], values[first + 1], values[first + 2], values[first + 3]};
  const std::vector<double> size = keys.numbers({"resolution"}, "the width and the height in pixels");
  if (size.size() == 2) {
    const TextNode& node = *keys.map().find("resolution");
    file.camera.width = keys.whole_pixels(node, "resolution", size[0]);
    file.camera.height = keys.whole_pixels(node, "resolution", size[1]);
  } else if (!size.empty()) {
    keys.fail(keys.where() + "resolution: expected two numbers, the width and the height in pixels");
  }
  if (first > 0)
    set_kalibr_wide_lens(keys, camera, model, values, file);
  else
    set_lens(keys, keys.text({"distortion_model"}), lens_list(keys), file);
  file.frame_rate = keys.optional_positive({"rate_hz"}, "frames a second");
  static const std::vector<std::string> known{
      "camera_model", "intrinsics", "distortion_model", "distortion_coeffs", "distortion_coefficients",
      "resolution",   "rate_hz",    "cam_overlaps",     "rostopic",          "timeshift_cam_imu",
      "T_cam_imu",    "T_cn_cnm1",  "sensor_type",      "comment",           "T_BS",
      "line-delay",   "line_delay", "T_imu_cam"};
  note_unknown(keys, "", known, file);
  return file;
}

}  // namespace detail
}  // namespace sslam
