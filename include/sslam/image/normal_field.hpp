// SPDX-License-Identifier: BSD-3-Clause
// The surface normals that an image shows, as votes for a Manhattan frame.
#pragma once

#include <cstddef>
#include <vector>

namespace sslam {

// Unit normals on planar regions, camera frame, pointing at the camera; weight in [0, 1] is the confidence.
// One array per component, so that a kernel can read a network's planes as they are.
struct NormalField {
  std::vector<float> x, y, z, weight;
  // What the normals of one plane get wrong together: standard deviation of their mean's direction per
  // component, radians. No number of normals averages it away.
  float plane_sigma = 0;

  [[nodiscard]] std::size_t size() const noexcept { return x.size(); }
  void clear() noexcept {
    for (auto* plane : {&x, &y, &z, &weight}) plane->clear();
    plane_sigma = 0;
  }
  void push_back(float nx, float ny, float nz, float w) {
    x.push_back(nx);
    y.push_back(ny);
    z.push_back(nz);
    weight.push_back(w);
  }
};

}  // namespace sslam
