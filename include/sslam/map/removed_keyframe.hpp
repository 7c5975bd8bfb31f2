// SPDX-License-Identifier: BSD-3-Clause
// What is left of a keyframe that was removed as redundant: its place, relative to its parent in a spanning
// tree, so that what hangs on its pose hangs on the parent's from then on.
#pragma once

#include <cstddef>
#include <vector>

#include "sslam/map/keyframe.hpp"

namespace sslam {

// `parent` is alive.
template <Scalar S>
[[nodiscard]] Keyframe<S> remains_of(const Keyframe<S>& keyframe, const Keyframe<S>& parent) {
  Keyframe<S> rest;
  rest.id = keyframe.id;
  rest.parent = parent.id;
  rest.cam_from_parent = keyframe.cam_from_world * parent.cam_from_world.inverse();
  return rest;
}

// The keyframe itself, or the parent that carries its place on.
template <Scalar S>
[[nodiscard]] KeyframeId survivor(const std::vector<Keyframe<S>>& keyframes, KeyframeId id) noexcept {
  const auto at = [&](KeyframeId k) -> const Keyframe<S>& { return keyframes[static_cast<std::size_t>(k)]; };
  while (!at(id).alive()) id = at(id).parent;
  return id;
}

// cam_from_world of a keyframe, alive or carried on by its parents.
template <Scalar S>
[[nodiscard]] SE3<S> keyframe_pose(const std::vector<Keyframe<S>>& keyframes, KeyframeId id) noexcept {
  const auto at = [&](KeyframeId k) -> const Keyframe<S>& { return keyframes[static_cast<std::size_t>(k)]; };
  SE3<S> cam_from_survivor;
  for (; !at(id).alive(); id = at(id).parent) cam_from_survivor = cam_from_survivor * at(id).cam_from_parent;
  return cam_from_survivor * at(id).cam_from_world;
}

}  // namespace sslam
