// SPDX-License-Identifier: BSD-3-Clause
// Where the normal network that comes with sslam lies: in the installed data, or in the source tree of a
// build.
#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "cli/input/default_normals.hpp"
#include "sslam/core/error.hpp"

namespace sslam::cli {

[[nodiscard]] inline std::array<std::filesystem::path, 2> shipped_model_places() {
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  return {program.parent_path() / SSLAM_MODELS_FROM_PROGRAM / "planar_normals.json", SSLAM_MODELS_IN_SOURCE};
}

// The manifest of the model; nothing when it is in neither place.
[[nodiscard]] inline std::optional<std::filesystem::path> find_shipped_model() {
  return first_model(shipped_model_places());
}

// As above. Throws Error when it is in neither place; `instead` says what the user can do.
[[nodiscard]] inline std::filesystem::path shipped_model(const std::string& instead) {
  if (const auto found = find_shipped_model()) return *found;
  throw Error("the normal network that comes with sslam is not installed; looked for " +
              shipped_model_places()[0].string() + "; " + instead);
}

}  // namespace sslam::cli
