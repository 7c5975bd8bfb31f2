// SPDX-License-Identifier: BSD-3-Clause
// What cameras of a kind have in common; docs/synth.md says where the values come from.
#pragma once

#include <map>
#include <string>

#include "cli/synth.hpp"

namespace sslam::cli {

struct CameraLook {
  int width, height;
  double rate;
  double focal_of_width;
  RadTan<double> lens;
  double read_out;  // seconds
  double blur;      // share of the frame time
  float noise, vignetting, exposure_drift, white_balance_drift;
  std::string image_format;
  int jpeg_quality;
  double tremor, shake;  // of what holds it
};

inline const CameraLook kWebcam{.width = 640,
                                .height = 480,
                                .rate = 30,
                                .focal_of_width = 0.82,
                                .lens = {0.06, -0.14, 0.001, -0.001, 0},
                                .read_out = 0.030,
                                .blur = 0.5,
                                .noise = 3.0f,
                                .vignetting = 0.25f,
                                .exposure_drift = 0.15f,
                                .white_balance_drift = 0.06f,
                                .image_format = "jpg",
                                .jpeg_quality = 75,
                                .tremor = 1.0,
                                .shake = 0.5};

inline const CameraLook kPhone{.width = 1920,
                               .height = 1080,
                               .rate = 30,
                               .focal_of_width = 0.80,
                               .lens = {0.08, -0.16, 0, 0, 0},
                               .read_out = 0.020,
                               .blur = 0.3,
                               .noise = 2.0f,
                               .vignetting = 0.10f,
                               .exposure_drift = 0.20f,
                               .white_balance_drift = 0.04f,
                               .image_format = "jpg",
                               .jpeg_quality = 85,
                               .tremor = 1.5,
                               .shake = 1.0};

inline const CameraLook kKinect{.width = 640,
                                .height = 480,
                                .rate = 30,
                                .focal_of_width = 0.82,
                                .lens = {0.12, -0.25, -0.002, 0.002, 0},
                                .read_out = 0.030,
                                .blur = 0.5,
                                .noise = 3.5f,
                                .vignetting = 0.20f,
                                .exposure_drift = 0.20f,
                                .white_balance_drift = 0.08f,
                                .image_format = "jpg",
                                .jpeg_quality = 95,
                                .tremor = 1.0,
                                .shake = 1.0};

inline const CameraLook kIndustrial{.width = 752,
                                    .height = 480,
                                    .rate = 20,
                                    .focal_of_width = 0.61,
                                    .lens = {-0.28, 0.07, 0.0002, 0.0, 0},
                                    .read_out = 0.0,
                                    .blur = 0.1,
                                    .noise = 2.5f,
                                    .vignetting = 0.20f,
                                    .exposure_drift = 0.0f,
                                    .white_balance_drift = 0.0f,
                                    .image_format = "png",
                                    .jpeg_quality = 95,
                                    .tremor = 0.5,
                                    .shake = 0.3};

inline const std::map<std::string, CameraLook> kCameraLooks{
    {"webcam", kWebcam}, {"phone", kPhone}, {"kinect", kKinect}, {"industrial", kIndustrial}};

inline void apply_look(const CameraLook& look, SynthSettings& settings) {
  settings.width = look.width;
  settings.height = look.height;
  settings.rate = look.rate;
  settings.focal_of_width = look.focal_of_width;
  settings.lens = look.lens;
  settings.read_out = look.read_out;
  settings.blur = look.blur;
  settings.sensor.noise = look.noise;
  settings.sensor.vignetting = look.vignetting;
  settings.sensor.exposure_drift = look.exposure_drift;
  settings.sensor.white_balance_drift = look.white_balance_drift;
  settings.image_format = look.image_format;
  settings.jpeg_quality = look.jpeg_quality;
  settings.house.motion.tremor = look.tremor;
  settings.house.motion.shake = look.shake;
}

}  // namespace sslam::cli
