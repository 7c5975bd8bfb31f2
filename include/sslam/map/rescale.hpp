// SPDX-License-Identifier: BSD-3-Clause
// The same map in another unit of length.
#pragma once

#include "sslam/map/map.hpp"

namespace sslam {

// The camera where lengths in the world are `factor` times what they were: its place alone changes.
template <Scalar S>
[[nodiscard]] SE3<S> rescaled(const SE3<S>& a_from_b, S factor) noexcept {
  return {a_from_b.rotation, a_from_b.translation * factor};
}

// Everything that is a length becomes `factor` > 0 times as long; nothing that an image sees changes.
template <Scalar S>
void rescale(Map<S>& map, S factor) {
  for (Keyframe<S>& kf : map.keyframes) {
    kf.cam_from_world = rescaled(kf.cam_from_world, factor);
    kf.cam_from_parent = rescaled(kf.cam_from_parent, factor);
  }
  for (PointLandmark<S>& point : map.points) {
    point.position *= factor;
    point.extent *= factor;
  }
  for (LineLandmark<S>& line : map.lines) {
    line.line.moment *= factor;
    line.start *= factor;
    line.end *= factor;
  }
  for (PlaneLandmark<S>& plane : map.planes) plane.plane.distance *= factor;
}

}  // namespace sslam
