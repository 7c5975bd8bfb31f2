// SPDX-License-Identifier: BSD-3-Clause
// What a System is made of. Nothing here needs a file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sslam/core/error.hpp"
#include "sslam/geometry/camera.hpp"
#include "sslam/system/normal_choice.hpp"
#include "sslam/system/parameter_value.hpp"

namespace sslam {

struct Settings {
  std::string preset = "structure";        // one of all_presets()
  std::vector<ParameterValue> parameters;  // those that differ from their defaults
  Camera<double> camera;                   // of the images, with their width and height
  // Images with a longer side are shrunk to it, pixels: thresholds in pixels hold for cameras of any
  // resolution. 0: none is.
  int longest_side = 960;
  NormalChoice normals;        // lines alone by default
  double depth_factor = 5000;  // value of one metre in a 16 bit depth image
  std::uint64_t seed = 1;      // of everything random
  // False: the same images give the same bits. True: mapping and loop closing have a thread of their own and
  // tracking never waits for them; no two runs are alike.
  bool live = false;
  // finish() adjusts the whole map, and tracks every frame again in it; 100 kB of memory a frame. False:
  // poses stay as they were when the next frame came.
  bool final_pass = true;
  bool keep_pictures = false;  // observers see the images, not only what was found in them
};

// Settings that contradict themselves or each other; what() begins with the field's name.
struct SettingsError : Error {
  SettingsError(std::string of_field, const std::string& why)
      : Error(of_field + ": " + why), field(std::move(of_field)) {}

  std::string field;
};

}  // namespace sslam
