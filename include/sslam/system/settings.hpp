// SPDX-License-Identifier: BSD-3-Clause
// The settings of a System. None of them needs a file.
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
  // Longest side of an image, pixels: larger images are shrunk to it, so that thresholds in pixels hold for
  // cameras of any resolution. 0: no limit.
  int longest_side = 960;
  NormalChoice normals;        // lines alone by default
  double depth_factor = 5000;  // value of one metre in a 16 bit depth image
  std::uint64_t seed = 1;      // of all random samples
  // False: the same images give the same results, bit for bit. True: mapping and loop closing have their own
  // thread, and tracking never waits for them; no two runs are equal.
  bool live = false;
  // True: finish() adjusts the whole map and tracks every frame again in it; 100 kB of memory per frame.
  // False: finish() does not change the poses.
  bool final_pass = true;
  bool keep_pictures = false;  // observers get the images, not only their features
};

// Invalid or contradictory settings; what() begins with the field's name.
struct SettingsError : Error {
  SettingsError(std::string of_field, const std::string& why)
      : Error(of_field + ": " + why), field(std::move(of_field)) {}

  std::string field;
};

}  // namespace sslam
