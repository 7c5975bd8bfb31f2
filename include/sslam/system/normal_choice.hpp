// SPDX-License-Identifier: BSD-3-Clause
// A source of surface normals that is chosen at run time; a model of the front end's concept.
#pragma once

#include <utility>
#include <variant>

#include "sslam/core/parameter_table.hpp"
#include "sslam/geometry/resized_camera.hpp"
#include "sslam/opencv/normals/depth_normals.hpp"
#include "sslam/opencv/normals/file_normals.hpp"
#include "sslam/opencv/normals/no_normals.hpp"
#include "sslam/opencv/normals/normal_picture.hpp"
#include "sslam/opencv/normals/onnx_normals.hpp"

namespace sslam {

struct NormalChoice {
  std::variant<NoNormals, DepthNormals, FileNormals, OnnxNormals> source;
  // True: the source runs only if a frame's lines do not determine its rotation
  // (track/localise/normal_demand.hpp), when the frame is tracked. False: it runs for every frame, while
  // features are extracted.
  bool on_demand = false;

  [[nodiscard]] NormalStatus fill(const ImageInput& input, const Camera<double>& camera, NormalField& field) {
    return std::visit([&](auto& chosen) { return chosen.fill(input, camera, field); }, source);
  }

  [[nodiscard]] bool any() const noexcept { return !std::holds_alternative<NoNormals>(source); }
  [[nodiscard]] bool from_depth() const noexcept { return std::holds_alternative<DepthNormals>(source); }

  // Parameters of the chosen source. Their names begin with the source: "depth.max_depth".
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    if (auto* depth = std::get_if<DepthNormals>(&self.source)) visit_stage("depth.", *depth, visit);
    if (auto* files = std::get_if<FileNormals>(&self.source)) visit_stage("files.", *files, visit);
    if (auto* network = std::get_if<OnnxNormals>(&self.source)) visit_stage("onnx.", *network, visit);
  }

  static constexpr int kColumns = 128;  // of the small picture of a network's normals, at most

  // A picture of the last frame's normals; empty if there is no source.
  [[nodiscard]] cv::Mat small_picture() const {
    if (const auto* network = std::get_if<OnnxNormals>(&source)) {
      if (network->manifest().kind != NetworkOutput::kNormals)
        return small_normal_picture(network->depth().grid());
      const double min_planar = network->options.evidence.min_planar;
      return small_normal_picture(sample_normals(network->dense(), min_planar, kColumns));
    }
    if (const auto* depth = std::get_if<DepthNormals>(&source)) return small_normal_picture(depth->grid());
    if (const auto* files = std::get_if<FileNormals>(&source)) return small_normal_picture(files->grid());
    return {};
  }

  // The pinhole of that picture's pixels, for a picture of this size; `camera` is that of the images. If the
  // source works on distorted pixels, the distortion is ignored.
  [[nodiscard]] Pinhole<double> small_pinhole(const Camera<double>& camera, cv::Size picture) const {
    if (const auto* network = std::get_if<OnnxNormals>(&source))
      if (network->manifest().kind == NetworkOutput::kNormals)
        return sampled_pinhole(network->dense(), kColumns);
    return resized(camera, picture.width, picture.height).pinhole;
  }
};
static_assert(NormalSource<NormalChoice> && Described<NormalChoice>);

// The parameters of all sources, with their defaults.
inline void collect_normal_parameters(ParameterTable& table) {
  const DepthNormalsOptions depth;
  const FileNormalsOptions files;
  const OnnxNormalsOptions network;
  table.collect([&](auto& visit) {
    visit_within("normals.depth.", depth, visit);
    visit_within("normals.files.", files, visit);
    visit_within("normals.onnx.", network, visit);
  });
}

}  // namespace sslam
