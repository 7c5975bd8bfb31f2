// SPDX-License-Identifier: BSD-3-Clause
// Calibrations of devices and robots with several cameras: the raw calibration of an Azure Kinect, and the
// sensors.yaml of OpenLORIS.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "sslam/opencv/camera/slam_cameras.hpp"

namespace sslam {
namespace detail {

[[nodiscard]] inline bool is_azure_kinect(const TextNode& root) {
  const TextNode* const all = root.find("CalibrationInformation");
  return all != nullptr && all->has("Cameras");
}

// An image of the colour camera shows all of its sensor of 4:3, or the middle of it at 16:9. Lengths are
// parts of the width and the height of that sensor, whose corner is (0, 0).
[[nodiscard]] inline CameraFile azure_colour(const CameraKeys& keys, const std::vector<double>& v,
                                             const std::string& name, int width, int height) {
  CameraFile file;
  file.name = name;
  file.camera.width = width;
  file.camera.height = height;
  const double whole = 0.75 * width, cut = 0.5 * (whole - height);
  file.camera.pinhole = {v[2] * width, v[3] * whole, v[0] * width - 0.5, v[1] * whole - cut - 0.5};
  set_lens(keys, "rational", {v[4], v[5], v[13], v[12], v[6], v[7], v[8], v[9]}, file);
  return file;
}

[[nodiscard]] inline CameraFile read_azure_kinect(const CameraKeys& top) {
  const TextNode& cameras = *map_under(top, "CalibrationInformation").map().find("Cameras");
  for (const TextNode& camera : cameras.items) {
    const TextNode* const purpose = camera.find("Purpose");
    if (purpose == nullptr || purpose->text != "CALIBRATION_CameraPurposePhotoVideo") continue;
    const CameraKeys keys = map_under(CameraKeys(camera, top.file(), "the colour camera's "), "Intrinsics");
    const std::string model = keys.text({"ModelType"});
    if (model != "CALIBRATION_LensDistortionModelBrownConrady") refuse_lens(keys, model);
    const std::vector<double> v = keys.numbers({"ModelParameters"}, "14 numbers, as the camera stores them");
    const bool plane = v.size() >= 14 && v[0] > 0 && v[0] < 1 && v[1] > 0 && v[1] < 1 && v[2] > 0 && v[3] > 0;
    if (!plane)
      keys.fail(keys.where() +
                "ModelParameters: expected 14 numbers, cx cy fx fy k1 to k6 codx cody p2 p1, "
                "the first four as parts of the sensor");
    if (v[10] != 0 || v[11] != 0)
      keys.fail(keys.where() +
                "ModelParameters: its centre of distortion is moved, which is not known here; " + kWayOut);
    return one_of(
        {azure_colour(keys, v, "color_4x3", 4096, 3072), azure_colour(keys, v, "color_16x9", 3840, 2160)});
  }
  top.fail("CalibrationInformation.Cameras has no colour camera (CALIBRATION_CameraPurposePhotoVideo)");
}

[[nodiscard]] inline bool is_openloris_sensors(const TextNode& root) {
  return std::any_of(root.items.begin(), root.items.end(), [](const TextNode& sensor) {
    return sensor.has("sensor_type") && sensor.has("intrinsics") && sensor.has("sensor_name");
  });
}

// It writes fx cx fy cy. Some write fx fy cx cy in its form: the focal lengths are those that are nearly
// equal.
[[nodiscard]] inline CameraFile read_openloris_camera(const CameraKeys& keys, const std::string& name) {
  CameraFile file;
  file.name = name;
  file.camera.width = keys.optional_pixels({"width"});
  file.camera.height = keys.optional_pixels({"height"});
  std::vector<double> v = keys.numbers({"intrinsics"}, "fx cx fy cy");
  if (v.size() != 4 || !std::all_of(v.begin(), v.end(), [](double value) { return value > 0; }))
    keys.fail(keys.where() + "intrinsics: expected the four numbers fx cx fy cy, greater than 0");
  if (std::abs(std::log(v[0] / v[2])) < std::abs(std::log(v[0] / v[1]))) std::swap(v[1], v[2]);
  file.camera.pinhole = {v[0], v[1], v[2], v[3]};
  set_lens(keys, keys.text({"distortion_model"}), lens_list(keys), file);
  file.frame_rate = keys.optional_positive({"fps"}, "frames a second");
  return file;
}

// The cameras of images: those of depth are left out.
[[nodiscard]] inline CameraFile read_openloris(const CameraKeys& top) {
  std::vector<CameraFile> cameras;
  for (std::size_t i = 0; i < top.map().items.size(); ++i) {
    const std::string& name = top.map().keys[i];
    const CameraKeys keys(top.map().items[i], top.file(), name + ".");
    if (keys.text({"sensor_type"}) != "camera" || name.find("depth") != std::string::npos) continue;
    cameras.push_back(read_openloris_camera(keys, name));
  }
  if (cameras.empty()) top.fail("has no sensor of the type camera with intrinsics");
  return one_of(std::move(cameras));
}

}  // namespace detail
}  // namespace sslam
