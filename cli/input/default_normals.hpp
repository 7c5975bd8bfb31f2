// SPDX-License-Identifier: BSD-3-Clause
// Which source of normals a run takes when nobody names one: the network that comes with sslam, on demand,
// where it is installed.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace sslam::cli {

// The first manifest whose model, the .onnx file of the same name, is there as well.
[[nodiscard]] inline std::optional<std::filesystem::path> first_model(
    std::span<const std::filesystem::path> manifests) {
  std::error_code ignored;
  for (const std::filesystem::path& manifest : manifests) {
    std::filesystem::path model = manifest;
    model.replace_extension(".onnx");
    if (std::filesystem::is_regular_file(manifest, ignored) &&
        std::filesystem::is_regular_file(model, ignored))
      return manifest;
  }
  return std::nullopt;
}

struct DefaultNormals {
  std::string source;  // as --normals takes it
  std::string note;    // for the user; empty: nothing to say
};

[[nodiscard]] inline DefaultNormals default_normals(const std::optional<std::filesystem::path>& shipped_model,
                                                    bool wanted) {
  if (!wanted) return {"none", ""};
  if (shipped_model) return {"on-demand", ""};
  return {"none",
          "the normal network that comes with sslam is not installed: the axes come from lines alone"};
}

}  // namespace sslam::cli
