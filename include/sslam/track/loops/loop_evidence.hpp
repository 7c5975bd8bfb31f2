// SPDX-License-Identifier: BSD-3-Clause
// What speaks for a closed loop, beside what it was closed by. A thing that stands at two places shows
// nothing but itself, however the map is bent for it; a place that is seen again shows what is around, too.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "sslam/map/map.hpp"
#include "sslam/track/contract/loop.hpp"
#include "sslam/track/matching/match_points.hpp"

namespace sslam {

// Of the points of the place that a keyframe sees, the share that the map has within `reach`, in the
// feature's sigma, of where they are seen.
template <Scalar S>
S share_in_place(const Map<S>& map, const Keyframe<S>& keyframe, const Loop<S>& loop, S reach) {
  int seen = 0, near = 0;
  for (std::size_t i = 0; i < loop.point_landmarks.size(); ++i) {
    if (loop.point_landmarks[i] == kNone) continue;
    ++seen;
    const PointFeature<S>& feature = keyframe.frame.points[i];
    const auto predicted = predict_point(map.points[map.index(loop.point_landmarks[i])], keyframe.frame,
                                         keyframe.cam_from_world, S(-1));
    near += predicted.visible && (predicted.pixel - feature.pixel).norm() < reach * feature.sigma;
  }
  return seen > 0 ? static_cast<S>(near) / static_cast<S>(seen) : S(0);
}

// Length of the way that the camera went from one keyframe to the other, either of which may be the older.
template <Scalar S>
S way_between(const Map<S>& map, KeyframeId a, KeyframeId b) {
  const auto centre = [&](std::size_t k) { return map.keyframes[k].cam_from_world.inverse().translation; };
  std::size_t last = map.index(std::min(a, b));
  S way = 0;
  for (std::size_t k = last + 1; k <= map.index(std::max(a, b)); ++k) {
    if (!map.keyframes[k].alive()) continue;
    way += (centre(k) - centre(last)).norm();
    last = k;
  }
  return way;
}

// Where a view shows landmarks of these places, widened by `margin` pixels; empty: it shows none.
template <Scalar S>
Eigen::AlignedBox<S, 2> box_around(std::span<const Vec3<S>> places, const Frame<S>& frame,
                                   const SE3<S>& cam_from_world, S margin) {
  Eigen::AlignedBox<S, 2> box;
  for (const Vec3<S>& place : places) {
    const Vec3<S> in_camera = cam_from_world * place;
    if (in_camera.z() > 0) box.extend(frame.pinhole.project(in_camera));
  }
  if (!box.isEmpty()) box = {box.min().array() - margin, box.max().array() + margin};
  return box;
}

// The points among a keyframe's features by which it was recognised at a place.
struct Sighting {
  KeyframeId keyframe = kNone;
  std::vector<std::size_t> features;
};

// Points that keyframes on both sides of a closed loop see, but not next to what they were recognised by.
// `apart` is a share of the image's width.
template <Scalar S>
int shared_beside(const Map<S>& map, std::span<const Sighting> known, std::span<const KeyframeId> here,
                  std::span<const KeyframeId> there, S apart) {
  std::vector<std::vector<Vec3<S>>> places(known.size());
  for (std::size_t n = 0; n < known.size(); ++n) {
    const auto& seen = map.keyframes[map.index(known[n].keyframe)].point_landmarks;
    for (const std::size_t i : known[n].features)
      if (seen[i] != kNone) places[n].push_back(map.points[map.index(seen[i])].position);
  }
  const auto seen_there = [&](LandmarkId id) {
    return std::any_of(there.begin(), there.end(),
                       [&](KeyframeId k) { return map.points[map.index(id)].seen_by(k); });
  };
  std::vector<Eigen::AlignedBox<S, 2>> boxes(known.size());
  std::vector<LandmarkId> shared;
  for (const KeyframeId k : here) {
    const Keyframe<S>& keyframe = map.keyframes[map.index(k)];
    const S margin = apart * static_cast<S>(keyframe.frame.width);
    for (std::size_t n = 0; n < known.size(); ++n)
      boxes[n] = box_around<S>(places[n], keyframe.frame, keyframe.cam_from_world, margin);
    for (std::size_t i = 0; i < keyframe.point_landmarks.size(); ++i) {
      const LandmarkId id = keyframe.point_landmarks[i];
      if (id == kNone || !seen_there(id)) continue;
      if (std::none_of(boxes.begin(), boxes.end(),
                       [&](const auto& box) { return box.contains(keyframe.frame.points[i].pixel); }))
        shared.push_back(id);
    }
  }
  std::sort(shared.begin(), shared.end());
  return static_cast<int>(std::unique(shared.begin(), shared.end()) - shared.begin());
}

}  // namespace sslam
