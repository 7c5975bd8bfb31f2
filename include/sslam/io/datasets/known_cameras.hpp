// SPDX-License-Identifier: BSD-3-Clause
// Published calibrations of the known datasets, so that they need no camera file.
#pragma once

#include <array>
#include <cctype>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "sslam/geometry/camera.hpp"
#include "sslam/io/datasets/dataset.hpp"
#include "sslam/io/files/files.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::io {

struct KnownCamera {
  std::string_view name;    // as --camera accepts it
  std::string_view source;  // where the values were published
  Camera<double> camera;
  double depth_factor = 0;  // depth image units a metre
  double frame_rate = 0;    // frames a second
};

[[nodiscard]] inline Camera<double> make_camera(double fx, double fy, double cx, double cy, double k1 = 0,
                                                double k2 = 0, double p1 = 0, double p2 = 0, double k3 = 0) {
  Camera<double> camera;
  camera.pinhole = {fx, fy, cx, cy};
  camera.distortion = {k1, k2, p1, p2, k3};
  camera.width = 640;
  camera.height = 480;
  return camera;
}

// The ROS-based colour calibrations on the TUM RGB-D benchmark's page of file formats (its depth images are
// registered to colour; fr3 is rectified), ICL-NUIM with its fy of -480 made positive (our images are
// y-down). The 585 of the 7-Scenes page is its depth camera's: the colour images have the 525 that OpenNI
// takes for that sensor.
[[nodiscard]] inline const std::array<KnownCamera, 5>& known_cameras() {
  static const std::array<KnownCamera, 5> cameras{{
      {"tum_fr1", "TUM RGB-D, freiburg1",
       make_camera(517.3, 516.5, 318.6, 255.3, 0.2624, -0.9531, -0.0054, 0.0026, 1.1633), 5000, 30},
      {"tum_fr2", "TUM RGB-D, freiburg2",
       make_camera(520.9, 521.0, 325.1, 249.7, 0.2312, -0.7849, -0.0033, -0.0001, 0.9172), 5000, 30},
      {"tum_fr3", "TUM RGB-D, freiburg3", make_camera(535.4, 539.2, 320.1, 247.6), 5000, 30},
      {"icl_nuim", "ICL-NUIM", make_camera(481.2, 480.0, 319.5, 239.5), 5000, 30},
      {"7scenes", "7-Scenes", make_camera(525, 525, 320, 240), 1000, 30},
  }};
  return cameras;
}

[[nodiscard]] inline std::optional<KnownCamera> find_known_camera(std::string_view name) {
  for (const KnownCamera& camera : known_cameras()) {
    if (camera.name == name) return camera;
  }
  return std::nullopt;
}

// "tum_fr1, tum_fr2, ...": for messages.
[[nodiscard]] inline std::string known_camera_names() {
  std::string names;
  for (const KnownCamera& camera : known_cameras()) add_to_list(names, camera.name);
  return names;
}

// The freiburgN or frN that stands in `text` as a word; 0: none.
[[nodiscard]] inline int freiburg_number(const std::string& text) {
  const std::string lower = lower_case(text);
  const auto letter = [&lower](std::size_t i) {
    return i < lower.size() && std::isalnum(static_cast<unsigned char>(lower[i])) != 0;
  };
  constexpr std::array<std::string_view, 2> kWords{"freiburg", "fr"};
  for (const std::string_view word : kWords) {
    for (std::size_t at = lower.find(word); at != std::string::npos; at = lower.find(word, at + 1)) {
      const std::size_t digit = at + word.size();
      const bool starts = at == 0 || !letter(at - 1);
      if (starts && digit < lower.size() && lower[digit] >= '1' && lower[digit] <= '3' &&
          !letter(digit + 1)) {
        return lower[digit] - '0';
      }
    }
  }
  return 0;
}

// By layout, and for TUM by what the list's comments and the folder's name say about the recording.
[[nodiscard]] inline std::optional<KnownCamera> known_camera_for(const Dataset& dataset) {
  switch (dataset.layout) {
    case Layout::kIclNuim:
      return find_known_camera("icl_nuim");
    case Layout::kSevenScenes:
      return find_known_camera("7scenes");
    case Layout::kTum:
      break;
    default:
      return std::nullopt;
  }
  std::error_code ignored;
  const std::filesystem::path root = std::filesystem::weakly_canonical(dataset.root, ignored);
  int number = freiburg_number(dataset.name_hint);
  if (number == 0) number = freiburg_number(root.filename().string());
  if (number == 0) return std::nullopt;
  return find_known_camera("tum_fr" + std::to_string(number));
}

}  // namespace sslam::io
