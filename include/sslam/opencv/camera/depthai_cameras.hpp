// SPDX-License-Identifier: BSD-3-Clause
// The calibration that an OAK camera of Luxonis keeps, as DepthAI writes it in JSON: the cameras of all
// sockets.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "sslam/opencv/camera/matrix_cameras.hpp"

namespace sslam {
namespace detail {

[[nodiscard]] inline bool is_depthai(const TextNode& root) {
  const TextNode* const list = root.find("cameraData");
  return list != nullptr && list->kind == TextNode::Kind::kList && !list->items.empty();
}

// Perspective lenses have the coefficients of OpenCV's rational model with prism and tilt, fisheyes the first
// four alone.
[[nodiscard]] inline CameraFile read_depthai_camera(const CameraKeys& keys) {
  CameraFile file;
  file.camera.width = keys.optional_pixels({"width"});
  file.camera.height = keys.optional_pixels({"height"});
  set_matrix(keys, "intrinsicMatrix", keys.numbers({"intrinsicMatrix"}, "a camera matrix"), file);
  const double type = keys.optional({"cameraType"}, 0, "0 (perspective) or 1 (fisheye)");
  std::vector<double> lens = keys.numbers({"distortionCoeff"}, "up to 14 distortion coefficients");
  if (type != 0 && type != 1)
    keys.fail(keys.where() + "cameraType is " + short_text(type) +
              "; expected 0 (perspective) or 1 (fisheye): " + kWayOut);
  if (type == 1) lens.resize(std::min<std::size_t>(lens.size(), 4));
  set_lens(keys, type == 1 ? "fisheye" : "rational", lens, file);
  return file;
}

// One of them; the others are `others` of the answer. Sockets without a calibration are left out.
[[nodiscard]] inline CameraFile read_depthai(const CameraKeys& top) {
  constexpr const char* kExpected = "; expected pairs of a socket and its camera, as DepthAI writes them";
  const TextNode& list = *top.map().find("cameraData");
  std::vector<CameraFile> cameras;
  std::vector<std::string> left_out;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const TextNode& pair = list.items[i];
    if (pair.kind != TextNode::Kind::kList || pair.items.size() != 2 ||
        pair.items[1].kind != TextNode::Kind::kMap)
      top.fail("cameraData[" + std::to_string(i) + "] is no pair" + kExpected);
    const auto socket = number_of(pair.items[0].text);
    if (!socket || *socket < 0 || *socket > 25 || *socket != std::floor(*socket))
      top.fail("cameraData[" + std::to_string(i) + "] has the socket '" + pair.items[0].text + "'" +
               kExpected);
    const std::string name = std::string("CAM_") + static_cast<char>('A' + static_cast<int>(*socket));
    const CameraKeys keys(pair.items[1], top.file(), name + ": ");
    const std::vector<double> matrix = keys.numbers({"intrinsicMatrix"}, "a camera matrix");
    if (std::all_of(matrix.begin(), matrix.end(), [](double value) { return value == 0; })) continue;
    try {
      cameras.push_back(read_depthai_camera(keys));
      cameras.back().name = name;
    } catch (const Error& error) {  // it may be another one's images
      left_out.emplace_back(error.what());
    }
  }
  if (cameras.empty() && !left_out.empty()) throw Error(left_out.front());
  for (CameraFile& camera : cameras)
    for (const std::string& why : left_out) camera.notes.push_back(why + "; left out");
  if (cameras.empty())
    top.fail("cameraData has no camera with an intrinsicMatrix; this device was never calibrated");
  return one_of(std::move(cameras));
}

}  // namespace detail
}  // namespace sslam
