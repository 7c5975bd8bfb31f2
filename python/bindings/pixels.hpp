// SPDX-License-Identifier: BSD-3-Clause
// Pixels of a camera's images, as kernels take them.
#pragma once

#include <cmath>

#include "sslam/geometry/camera.hpp"

namespace sslam::python {

[[nodiscard]] inline Vec2<double> undistorted(const Camera<double>& camera, const double* pixel) {
  return camera.undistort_pixel({pixel[0], pixel[1]});
}

[[nodiscard]] inline double focal_of(const Camera<double>& camera) {
  return std::sqrt(camera.pinhole.fx * camera.pinhole.fy);
}

}  // namespace sslam::python
