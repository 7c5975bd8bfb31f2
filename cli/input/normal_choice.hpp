// SPDX-License-Identifier: BSD-3-Clause
// What --normals says, as a source of normals.
#pragma once

#include <string>

#include "sslam/system/normal_choice.hpp"

namespace sslam::cli {

// From "none", "depth", "files:DIR", "onnx" (the shipped model) or "onnx:FILE". Throws a std::exception with
// one line for anything else, and for a folder or a model that does not do.
[[nodiscard]] NormalChoice choose_normals(const std::string& text);

}  // namespace sslam::cli
