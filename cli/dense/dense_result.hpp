// SPDX-License-Identifier: BSD-3-Clause
// The dense model of a finished run: `sslam run --dense`.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cli/dense/keyframe_pictures.hpp"
#include "cli/dense/plane_texture.hpp"
#include "sslam/map/map.hpp"

namespace sslam::cli {

struct DenseResult {
  dense::DenseModel model;
  Atlas atlas;
  Vec3<double> up = Vec3<double>::UnitY();  // unit, of the map
  std::size_t keyframes = 0;                // with images
  bool colour = false;
  bool normals = false;
  double seconds = 0;
  std::vector<std::string> warnings;  // a line each

  [[nodiscard]] bool empty() const noexcept { return model.planes.empty(); }
};

// From the keyframes from `first` on whose pictures are there; `camera`: that of the pictures. Empty, with a
// line that says why, where there are no planes.
[[nodiscard]] DenseResult make_dense(const Map<double>& map, std::size_t first,
                                     const KeyframePictures& pictures, const Camera<double>& camera);

// Both files; none of an empty result. Throws Error.
void write_dense(const std::filesystem::path& folder, const DenseResult& result);

// What metrics.json says of it.
[[nodiscard]] nlohmann::ordered_json dense_json(const DenseResult& result);

}  // namespace sslam::cli
