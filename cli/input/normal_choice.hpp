// SPDX-License-Identifier: BSD-3-Clause
// What --normals says, as a source of normals.
#pragma once

#include <string>

#include "sslam/system/normal_choice.hpp"

namespace sslam::cli {

// From "none", "depth", "files:DIR", "onnx" (the shipped model) or "onnx:FILE"; "on-demand:" before one of
// them asks it where lines leave the rotation open, "on-demand" alone the shipped model. Throws a
// std::exception with one line for anything else, and for a folder or a model that does not do.
[[nodiscard]] NormalChoice choose_normals(const std::string& text);

inline constexpr const char* kOnDemand = "on-demand";

// The source alone: "depth" of "on-demand:depth", "onnx" of "on-demand".
[[nodiscard]] std::string source_of_normals(const std::string& text);

}  // namespace sslam::cli
