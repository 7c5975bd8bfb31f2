// SPDX-License-Identifier: BSD-3-Clause
// Two maps become one: the second moves into the world of the first, and its ids follow those of the first.
#pragma once

#include <utility>
#include <vector>

#include "sslam/core/move_to_end.hpp"
#include "sslam/map/map_deformation.hpp"
#include "sslam/track/contract/loop_answer.hpp"
#include "sslam/track/loops/axis_names.hpp"

namespace sslam {

namespace detail {

inline void shift_ids(LandmarkCommon& landmark, const IdShift& shift) {
  for (Observation& o : landmark.observations) o.keyframe += shift.keyframes;
  IdShift::apply(landmark.first_keyframe, shift.keyframes);
  IdShift::apply(landmark.plane, shift.planes);
}

}  // namespace detail

// `map_from_other` is how the other world stands in the map's. Where both know a Manhattan frame, within
// `max_turn`, radians, what the other map has seen of it counts as seen of the map's own. Nothing is fused
// yet.
template <Scalar S>
IdShift append(Map<S>& map, Map<S> other, const Sim3<S>& map_from_other, S max_turn) {
  const IdShift shift{
      static_cast<std::int32_t>(map.keyframes.size()), static_cast<std::int32_t>(map.points.size()),
      static_cast<std::int32_t>(map.lines.size()), static_cast<std::int32_t>(map.planes.size())};
  std::vector<Sim3<S>> moves(other.keyframes.size(), map_from_other);
  deform<S>(other, moves);
  const AxisNames<S> names =
      name_axes(map.world_from_manhattan, other.world_from_manhattan, map_from_other.rotation, max_turn);
  const SO3<S> other_from_map = names.into_from_other.inverse();
  for (Keyframe<S>& kf : other.keyframes) {
    IdShift::apply(kf.id, shift.keyframes);
    IdShift::apply(kf.parent, shift.keyframes);
    for (Neighbour& n : kf.neighbours) n.keyframe += shift.keyframes;
    shift.apply_to_matches(kf);
    for (std::int8_t& axis : kf.line_axes) axis = names(axis);
    if (kf.manhattan) kf.manhattan->cam_from_world = kf.manhattan->cam_from_world * other_from_map;
  }
  for (PointLandmark<S>& point : other.points) detail::shift_ids(point, shift);
  for (LineLandmark<S>& line : other.lines) {
    detail::shift_ids(line, shift);
    line.axis = names(line.axis);
  }
  for (PlaneLandmark<S>& plane : other.planes) plane.axis = names(plane.axis);
  move_to_end(other.keyframes, map.keyframes);
  move_to_end(other.points, map.points);
  move_to_end(other.lines, map.lines);
  move_to_end(other.planes, map.planes);
  map.collect_free_ids();
  return shift;
}

}  // namespace sslam
