// SPDX-License-Identifier: BSD-3-Clause
// A camera as the text of a file that --camera reads, and ORB-SLAM too.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <string>

#include "sslam/opencv/camera/camera_file.hpp"

namespace sslam::cli {

// `remarks`: lines of comment behind the heading, each ended; may be empty. What is 0 is left out, but for
// the coefficients that every reader expects. A fisheye has ORB-SLAM3's names. With 17 digits, the same
// camera is read again, to the bit.
[[nodiscard]] inline std::string camera_yaml(const CameraFile& file, const std::string& remarks,
                                             int digits = 9) {
  const Pinhole<double>& pinhole = file.camera.pinhole;
  const RadTan<double>& lens = file.camera.distortion;
  const bool fisheye = file.wide && file.wide->model == WideModel::kFisheye;
  std::string text = "%YAML:1.0\n---\n" + remarks +
                     (fisheye ? "Camera.type: \"KannalaBrandt8\"\n" : "Camera.type: \"PinHole\"\n");
  const auto number = [&text, digits](const char* key, double value) {
    text += cv::format("%s: %.*g\n", key, digits, value);
  };
  number("Camera.fx", pinhole.fx);
  number("Camera.fy", pinhole.fy);
  number("Camera.cx", pinhole.cx);
  number("Camera.cy", pinhole.cy);
  if (fisheye) {
    constexpr std::array kNames{"Camera.k1", "Camera.k2", "Camera.k3", "Camera.k4"};
    for (std::size_t i = 0; i < kNames.size(); ++i) number(kNames[i], file.wide->k[i]);
  } else {
    number("Camera.k1", lens.k1);
    number("Camera.k2", lens.k2);
    number("Camera.p1", lens.p1);
    number("Camera.p2", lens.p2);
    if (lens.k3 != 0) number("Camera.k3", lens.k3);
  }
  text += cv::format("Camera.width: %d\nCamera.height: %d\n", file.camera.width, file.camera.height);
  if (file.frame_rate > 0) number("Camera.fps", file.frame_rate);
  text += "Camera.RGB: 1\n";
  if (file.depth_factor > 0) number("DepthMapFactor", file.depth_factor);
  return text;
}

}  // namespace sslam::cli
