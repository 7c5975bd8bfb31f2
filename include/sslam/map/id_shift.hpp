// SPDX-License-Identifier: BSD-3-Clause
// What is added to the ids of a map that becomes part of another.
#pragma once

#include <cstdint>

#include "sslam/map/landmark.hpp"

namespace sslam {

struct IdShift {
  std::int32_t keyframes = 0, points = 0, lines = 0, planes = 0;

  static void apply(std::int32_t& id, std::int32_t shift) noexcept {
    if (id != kNone) id += shift;
  }
  // Of a frame or a keyframe.
  void apply_to_matches(std::vector<LandmarkId>& point_landmarks,
                        std::vector<LandmarkId>& line_landmarks) const {
    for (LandmarkId& id : point_landmarks) apply(id, points);
    for (LandmarkId& id : line_landmarks) apply(id, lines);
  }
};

}  // namespace sslam
