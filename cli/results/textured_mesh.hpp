// SPDX-License-Identifier: BSD-3-Clause
// The surfaces of `--dense` as triangles with one texture, and how they are read back from model.glb.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "sslam/core/types.hpp"

namespace sslam::cli {

// Triangles that are seen from the side from which they were filmed, in the coordinates of the map.
struct TexturedMesh {
  std::vector<Vec3<float>> places, normals;
  std::vector<Vec2<float>> textures;  // 0 to 1 over the image, from its upper left corner
  std::vector<std::uint32_t> indices;
  std::vector<unsigned char> jpeg;

  [[nodiscard]] bool empty() const noexcept { return indices.empty(); }
};

// Of a file as write_glb writes it. The texture is not decoded. Throws Error where the file is another, or is
// damaged: what is read is finite, and no index is beyond the places.
[[nodiscard]] TexturedMesh read_glb(const std::filesystem::path& path);

}  // namespace sslam::cli
