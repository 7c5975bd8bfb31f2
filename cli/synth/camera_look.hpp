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

inline const std::map<std::string, CameraLook> kCameraLooks{{"webcam",
                                                             {640,
                                                              480,
                                                              30,
                                                              0.82,
                                                              {0.06, -0.14, 0.001, -0.001, 0},
                                                              0.030,
                                                              0.5,
                                                              3.0f,
                                                              0.25f,
                                                              0.15f,
                                                              0.06f,
                                                              "jpg",
                                                              75,
                                                              1.0,
                                                              0.5}},
                                                            {"phone",
                                                             {1920,
                                                              1080,
                                                              30,
                                                              0.80,
                                                              {0.08, -0.16, 0, 0, 0},
                                                              0.020,
                                                              0.3,
                                                              2.0f,
                                                              0.10f,
                                                              0.20f,
                                                              0.04f,
                                                              "jpg",
                                                              85,
                                                              1.5,
                                                              1.0}},
                                                            {"kinect",
                                                             {640,
                                                              480,
                                                              30,
                                                              0.82,
                                                              {0.12, -0.25, -0.002, 0.002, 0},
                                                              0.030,
                                                              0.5,
                                                              3.5f,
                                                              0.20f,
                                                              0.20f,
                                                              0.08f,
                                                              "jpg",
                                                              95,
                                                              1.0,
                                                              1.0}},
                                                            {"industrial",
                                                             {752,
                                                              480,
                                                              20,
                                                              0.61,
                                                              {-0.28, 0.07, 0.0002, 0.0, 0},
                                                              0.0,
                                                              0.1,
                                                              2.5f,
                                                              0.20f,
                                                              0.0f,
                                                              0.0f,
                                                              "png",
                                                              95,
                                                              0.5,
                                                              0.3}}};

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
