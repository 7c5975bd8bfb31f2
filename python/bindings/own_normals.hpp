// SPDX-License-Identifier: BSD-3-Clause
// Normals that the caller computed, by a network of his own say, as votes for the rotation.
#pragma once

#include <opencv2/core.hpp>

#include "sslam/core/parameter_table.hpp"
#include "sslam/geometry/resized_camera.hpp"
#include "sslam/opencv/normals/onnx_normals.hpp"

namespace sslam::python {

// `map`: x, y, z in the camera frame, and perhaps the probability of a plane as a fourth channel; float, in
// the shape of the camera's image. Zero where there is none. They are judged as a network's output is, by the
// parameters normals.onnx.*; `field` stays empty unless the answer is kOk.
[[nodiscard]] inline NormalStatus take_normals(const cv::Mat& map, const Camera<double>& camera,
                                               const OnnxNormalsOptions& options, double plane_sigma,
                                               NormalField& field) {
  field.clear();
  const double sx = static_cast<double>(map.cols) / camera.width,
               sy = static_cast<double>(map.rows) / camera.height;
  if (std::abs(sx / sy - 1) > 0.02) return NormalStatus::kWrongSize;
  DenseNormals dense;
  dense.pinhole = resized(camera.pinhole, sx, sy);
  dense.normal.create(map.size());
  const int channels = map.channels();
  if (channels == 4) dense.planar.create(map.size());
  std::size_t bad = 0, unit = 0, away = 0;
  for (int v = 0; v < map.rows; ++v) {
    for (int u = 0; u < map.cols; ++u) {
      const float* const value = map.ptr<float>(v) + static_cast<std::ptrdiff_t>(u) * channels;
      const Vec3<double> n = Vec3<float>(value[0], value[1], value[2]).cast<double>();
      const float planar = channels == 4 ? value[3] : 1.0F;
      const double norm = n.norm();
      const bool is_unit = std::abs(norm - 1) <= options.max_norm_error;
      const bool is_share = planar >= -options.max_range_error && planar <= 1 + options.max_range_error;
      bad += (is_unit || norm == 0) && is_share ? 0U : 1U;
      const bool faces = n.dot(dense.pinhole.unproject(Vec2<double>(u, v))) < 0;
      unit += is_unit ? 1U : 0U;
      away += is_unit && !faces ? 1U : 0U;
      const bool keep = is_unit && is_share && faces;
      const Vec3<float> kept =
          keep ? Vec3<float>((n / norm).cast<float>()) : Vec3<float>(Vec3<float>::Zero());
      dense.normal(v, u) = {kept.x(), kept.y(), kept.z()};
      if (channels == 4) dense.planar(v, u) = keep ? planar : 0.0F;
    }
  }
  if (static_cast<double>(bad) > options.max_bad_share * static_cast<double>(map.total()))
    return NormalStatus::kBadOutput;
  if (2 * away > unit) return NormalStatus::kFacesAway;
  const NormalEvidence evidence = select_normals(dense, options.evidence, field);
  field.plane_sigma = static_cast<float>(plane_sigma);
  return evidence.enough ? NormalStatus::kOk : NormalStatus::kNoEvidence;
}

// normals.onnx.*, as they are set.
[[nodiscard]] inline OnnxNormalsOptions own_normals_options(const ParameterTable& table) {
  OnnxNormalsOptions options;
  table.write([&](auto& visit) { visit_within("normals.onnx.", options, visit); });
  return options;
}

}  // namespace sslam::python
