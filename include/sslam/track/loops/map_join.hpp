// SPDX-License-Identifier: BSD-3-Clause
// Two maps become one: the second moves into the world of the first, and its ids follow those of the first.
#pragma once

#include <utility>
#include <vector>

#include "sslam/map/map_deformation.hpp"
#include "sslam/track/loops/axis_names.hpp"

namespace sslam {

// `map_from_other` is how the other world stands in the map's. Where both know a Manhattan frame, within
// `max_turn`, radians, what the other map has seen of it counts as seen of the map's own. Nothing is fused
// yet.
template <Scalar S>
IdShift append(Map<S>& map, Map<S> other, const Sim3<S>& map_from_other, S max_turn) {
  std::vector<Sim3<S>> moves(other.keyframes.size(), map_from_other);
  deform<S>(other, moves);
  const AxisNames<S> names =
      name_axes(map.world_from_manhattan, other.world_from_manhattan, map_from_other.rotation, max_turn);
  const SO3<S> other_from_map = names.into_from_other.inverse();
  for (Keyframe<S>& kf : other.keyframes) {
    for (std::int8_t& axis : kf.line_axes) axis = names(axis);
    if (kf.manhattan) kf.manhattan->cam_from_world = kf.manhattan->cam_from_world * other_from_map;
  }
  for (LineLandmark<S>& line : other.lines) line.axis = names(line.axis);
  for (PlaneLandmark<S>& plane : other.planes) plane.axis = names(plane.axis);
  return map.append(std::move(other));
}

}  // namespace sslam
