// SPDX-License-Identifier: BSD-3-Clause
// Where the normal network that comes with sslam lies: in the installed data, or in the source tree of a
// build.
#pragma once

#include <filesystem>

#include "sslam/io/error.hpp"

namespace sslam::cli {

// The manifest of the model. Throws io::Error when it is in neither place.
[[nodiscard]] inline std::filesystem::path shipped_model() {
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const std::filesystem::path installed =
      program.parent_path() / SSLAM_MODELS_FROM_PROGRAM / "planar_normals.json";
  for (const std::filesystem::path& place : {installed, std::filesystem::path(SSLAM_MODELS_IN_SOURCE)}) {
    if (std::filesystem::is_regular_file(place, ignored)) return place;
  }
  throw io::Error("--normals onnx: the model that comes with sslam is not installed; looked for " +
                  installed.string() + "; name one with onnx:FILE");
}

}  // namespace sslam::cli
