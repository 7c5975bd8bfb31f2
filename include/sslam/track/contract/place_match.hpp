// SPDX-License-Identifier: BSD-3-Clause
// A place that was recognised once and waits for confirmation.
#pragma once

#include <vector>

#include "sslam/geometry/sim3.hpp"

namespace sslam {

// A keyframe of one map ("here") was found in another map ("there"), or elsewhere in the same map.
template <Scalar S>
struct PlaceMatch {
  Sim3<S> there_from_here;
  std::vector<Vec3<S>> places;  // positions of the landmarks that it saw there; of lines, their middles
};

}  // namespace sslam
