// SPDX-License-Identifier: BSD-3-Clause
// Whether two cameras are the same, so that tables made for one serve the other.
#pragma once

#include "sslam/geometry/camera.hpp"

namespace sslam {

[[nodiscard]] inline bool same_camera(const Camera<double>& a, const Camera<double>& b) noexcept {
  const auto &p = a.pinhole, &q = b.pinhole;
  const auto &d = a.distortion, &e = b.distortion;
  return a.width == b.width && a.height == b.height && p.fx == q.fx && p.fy == q.fy && p.cx == q.cx &&
         p.cy == q.cy && d.k1 == e.k1 && d.k2 == e.k2 && d.p1 == e.p1 && d.p2 == e.p2 && d.k3 == e.k3;
}

}  // namespace sslam
