// SPDX-License-Identifier: BSD-3-Clause
// A keyframe that shows a place of the map, or of another one, which it is not connected with.
#pragma once

#include <vector>

#include "sslam/geometry/sim3.hpp"
#include "sslam/map/landmark.hpp"

namespace sslam {

template <Scalar S>
struct Loop {
  KeyframeId place = kNone;  // the keyframe that was met again
  Sim3<S> cam_from_world;    // of the keyframe that closes the loop, in the world as it is around `place`
  std::vector<LandmarkId> point_landmarks;  // of that place, one for each of its features or kNone
  std::vector<LandmarkId> line_landmarks;
  int matches = 0;

  // How the keyframe's world stands in that of the place.
  [[nodiscard]] Sim3<S> there_from_here(const SE3<S>& cam_from_here) const {
    return cam_from_world.inverse() * similarity(cam_from_here);
  }
};

}  // namespace sslam
