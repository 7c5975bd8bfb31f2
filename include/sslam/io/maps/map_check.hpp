// SPDX-License-Identifier: BSD-3-Clause
// Whether a map that came from outside holds together.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sslam/core/error.hpp"
#include "sslam/map/map.hpp"

namespace sslam::io {

namespace map_check_detail {

inline void demand(bool holds) {
  if (!holds) throw Error("contradicts itself");
}

inline bool inside(std::int32_t id, std::size_t size) {
  return id >= 0 && static_cast<std::size_t>(id) < size;
}

inline bool is_unit(const Vec3<double>& v) {
  return std::abs(v.norm() - 1) < 1e-6;
}

// Parents come from those that were alive when it went; a ring of them would have no pose. Each keyframe is
// passed once, however long the chains are.
inline void check_parents(const Map<double>& map) {
  enum class Known : std::uint8_t { kNo, kOnTheWay, kYes };
  std::vector<Known> known(map.keyframes.size(), Known::kNo);
  std::vector<std::size_t> way;
  for (std::size_t start = 0; start < map.keyframes.size(); ++start) {
    way.clear();
    for (std::size_t at = start; known[at] != Known::kYes;) {
      demand(known[at] == Known::kNo);
      known[at] = Known::kOnTheWay;
      way.push_back(at);
      const KeyframeId parent = map.keyframes[at].parent;
      if (parent == kNone) break;
      demand(inside(parent, map.keyframes.size()));
      at = map.index(parent);
    }
    for (const std::size_t passed : way) known[passed] = Known::kYes;
  }
}

inline void check_keyframe(const Map<double>& map, std::size_t k, int axes) {
  const Keyframe<double>& kf = map.keyframes[k];
  demand(kf.id == static_cast<KeyframeId>(k));
  demand(kf.point_landmarks.size() == kf.frame.points.size());
  demand(kf.line_landmarks.size() == kf.frame.lines.size());
  demand(kf.line_axes.empty() || kf.line_axes.size() == kf.frame.lines.size());
  for (const std::int8_t axis : kf.line_axes) demand(axis < axes);
  for (const LandmarkId id : kf.point_landmarks) demand(id == kNone || inside(id, map.points.size()));
  for (const LandmarkId id : kf.line_landmarks) demand(id == kNone || inside(id, map.lines.size()));
  for (const Neighbour& n : kf.neighbours)
    demand(n.keyframe != kf.id && inside(n.keyframe, map.keyframes.size()) &&
           map.keyframes[map.index(n.keyframe)].alive());
}

// features(keyframe): how many the landmarks' observations can choose from.
template <class Landmarks, class Features>
void check_landmarks(const Map<double>& map, const Landmarks& landmarks, Features features) {
  for (const auto& landmark : landmarks) {
    demand(landmark.alive || (landmark.plane == kNone && landmark.observations.empty()));
    demand(landmark.first_keyframe == kNone || inside(landmark.first_keyframe, map.keyframes.size()));
    demand(landmark.plane == kNone ||
           (inside(landmark.plane, map.planes.size()) && map.planes[map.index(landmark.plane)].alive));
    for (const Observation& o : landmark.observations)
      demand(inside(o.keyframe, map.keyframes.size()) &&
             inside(o.feature, features(map.keyframes[map.index(o.keyframe)])));
  }
}

// An observation stands twice: the landmark names the keyframe's feature, and the feature the landmark.
// seen(keyframe): the landmarks of its features.
template <class Landmarks, class Seen>
void check_links(const Map<double>& map, const Landmarks& landmarks, Seen seen) {
  std::size_t observations = 0, features = 0;
  for (std::size_t id = 0; id < landmarks.size(); ++id)
    for (const Observation& o : landmarks[id].observations) {
      const Keyframe<double>& kf = map.keyframes[map.index(o.keyframe)];
      demand(kf.alive() && seen(kf)[map.index(o.feature)] == static_cast<LandmarkId>(id));
      ++observations;
    }
  for (const Keyframe<double>& kf : map.keyframes)
    for (std::size_t i = 0; i < seen(kf).size(); ++i) {
      if (seen(kf)[i] == kNone) continue;
      const auto& named = landmarks[map.index(seen(kf)[i])].observations;
      demand(std::any_of(named.begin(), named.end(), [&](const Observation& o) {
        return o.keyframe == kf.id && map.index(o.feature) == i;
      }));
      ++features;
    }
  demand(observations == features);
}

}  // namespace map_check_detail

// Throws Error when the parts of a map, each within its range (map_fields.hpp), do not fit each other: such a
// map would crash its reader.
inline void check_map(const Map<double>& map) {
  using namespace map_check_detail;
  const int axes = 3 * static_cast<int>(map.world_from_manhattan.size());
  if (map.keyframes.empty()) throw Error("is an empty map: it was saved before anything was tracked");
  demand(map.keyframes.front().alive());
  check_parents(map);
  for (std::size_t k = 0; k < map.keyframes.size(); ++k) check_keyframe(map, k, axes);
  check_landmarks(map, map.points, [](const Keyframe<double>& kf) { return kf.frame.points.size(); });
  check_landmarks(map, map.lines, [](const Keyframe<double>& kf) { return kf.frame.lines.size(); });
  check_links(
      map, map.points, [](const Keyframe<double>& kf) -> auto& { return kf.point_landmarks; });
  check_links(
      map, map.lines, [](const Keyframe<double>& kf) -> auto& { return kf.line_landmarks; });
  for (const auto& l : map.lines) demand(is_unit(l.line.direction) && l.axis < axes);
  for (const auto& p : map.planes) demand(is_unit(p.plane.normal) && p.axis < axes);
}

}  // namespace sslam::io
