// SPDX-License-Identifier: BSD-3-Clause
// The normal source that the user chose at run time, behind the front end's concept.
#pragma once

#include <string>
#include <variant>

#include "sslam/core/parameter_table.hpp"
#include "sslam/opencv/normals/depth_normals.hpp"
#include "sslam/opencv/normals/file_normals.hpp"
#include "sslam/opencv/normals/no_normals.hpp"
#include "sslam/opencv/normals/onnx_normals.hpp"

namespace sslam::cli {

struct NormalChoice {
  std::variant<NoNormals, DepthNormals, FileNormals, OnnxNormals> source;

  [[nodiscard]] NormalStatus fill(const ImageInput& input, const Camera<double>& camera, NormalField& field) {
    return std::visit([&](auto& chosen) { return chosen.fill(input, camera, field); }, source);
  }

  // Of the chosen source, which comes before their names: "depth.max_depth".
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    if (auto* depth = std::get_if<DepthNormals>(&self.source)) visit_stage("depth.", *depth, visit);
    if (auto* files = std::get_if<FileNormals>(&self.source)) visit_stage("files.", *files, visit);
    if (auto* network = std::get_if<OnnxNormals>(&self.source)) visit_stage("onnx.", *network, visit);
  }

  // The normals of the last frame, to look at; empty where there is no source of them.
  [[nodiscard]] cv::Mat small_picture() const;
};
static_assert(NormalSource<NormalChoice> && Described<NormalChoice>);

// The same of every source, with their defaults.
void collect_normal_parameters(ParameterTable& table);

// From "none", "depth", "files:DIR", "onnx" (the shipped model) or "onnx:FILE". Throws a std::exception with
// one line for anything else, and for a folder or a model that does not do.
[[nodiscard]] NormalChoice choose_normals(const std::string& text);

}  // namespace sslam::cli
