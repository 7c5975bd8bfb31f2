// SPDX-License-Identifier: BSD-3-Clause
// What a camera without noise sees of a scene: colour, depth and normals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sslam/core/types.hpp"

namespace sslam::synth {

struct RenderedFrame {
  int width = 0, height = 0;
  std::vector<float> rgb;  // display values, 3 per pixel, row by row; averaged over the pixel's area
  std::vector<float> inverse_depth;   // 1/z per metre at the pixel's centre, 0 where nothing is seen
  std::vector<std::int32_t> surface;  // index into normals at the pixel's centre, -1 where nothing is seen
  std::vector<Vec3<float>> normals;   // camera frame, unit, towards the camera
  std::vector<std::int32_t> face;     // the scene's face of each entry of normals

  void resize(int new_width, int new_height) {
    width = new_width;
    height = new_height;
    const std::size_t pixels = static_cast<std::size_t>(width) * height;
    rgb.resize(3 * pixels);
    inverse_depth.assign(pixels, 0.0f);
    surface.assign(pixels, -1);
    normals.clear();
    face.clear();
  }
};

}  // namespace sslam::synth
