// SPDX-License-Identifier: BSD-3-Clause
// A place that was met once and waits for a second sighting.
#pragma once

#include <vector>

#include "sslam/geometry/sim3.hpp"

namespace sslam {

// A keyframe of one map, here, was found in another, there; or elsewhere in the same one.
template <Scalar S>
struct PlaceMatch {
  Sim3<S> there_from_here;
  std::vector<Vec3<S>> places;  // of the landmarks that it saw there; of lines, their middles
};

}  // namespace sslam
