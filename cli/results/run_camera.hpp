// SPDX-License-Identifier: BSD-3-Clause
// The camera that the images of a run were tracked with, as its metrics.json tells it.
#pragma once

#include <array>
#include <nlohmann/json.hpp>

#include "cli/results/run_folder.hpp"
#include "sslam/core/error.hpp"
#include "sslam/geometry/camera.hpp"

namespace sslam::cli {

// Of the images as they are. Throws Error when the settings do not tell it.
[[nodiscard]] inline Camera<double> camera_of(const RunFolder& run) {
  try {
    const auto& settings = run.metrics.at("settings");
    const auto p = settings.at("pinhole").get<std::array<double, 4>>();
    const auto lens = settings.at("distortion").get<std::array<double, 5>>();
    const auto size = settings.at("image_size").get<std::array<int, 2>>();
    return {{p[0], p[1], p[2], p[3]}, {lens[0], lens[1], lens[2], lens[3], lens[4]}, size[0], size[1]};
  } catch (const nlohmann::json::exception&) {
    throw Error("metrics.json: lacks the camera of the run (settings: pinhole, distortion, image_size)");
  }
}

}  // namespace sslam::cli
