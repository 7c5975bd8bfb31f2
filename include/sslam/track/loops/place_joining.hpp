// SPDX-License-Identifier: BSD-3-Clause
// What a keyframe and its neighbours see of a place that is met again becomes one with what the map has
// there.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sslam/map/local_map.hpp"
#include "sslam/map/map.hpp"
#include "sslam/track/contract/loop.hpp"
#include "sslam/track/mapping/fusion.hpp"

namespace sslam {

template <Scalar S>
class PlaceJoining {
 public:
  LandmarkFusion<S> fusion;

  // First what the loop matched, then what each keyframe around `id` shows of the `keyframes` around the
  // place.
  void join(Map<S>& map, KeyframeId id, const Loop<S>& loop, std::size_t keyframes) {
    std::vector<KeyframeId> here;
    take_with_neighbours(map.keyframes[map.index(id)], map.keyframes.size(), here);
    place_.gather_around(map, loop.place, keyframes);
    take_over(
        map, id, loop.point_landmarks, &Keyframe<S>::point_landmarks, map.points,
        [&](LandmarkId from, LandmarkId into) { map.fuse_points(from, into); },
        [&](LandmarkId landmark, std::size_t feature) { map.observe_point(landmark, id, feature); });
    take_over(
        map, id, loop.line_landmarks, &Keyframe<S>::line_landmarks, map.lines,
        [&](LandmarkId from, LandmarkId into) { map.fuse_lines(from, into); },
        [&](LandmarkId landmark, std::size_t feature) { map.observe_line(landmark, id, feature); });
    take_in(map, here, place_);
    update_covisibility(map, here);
  }

  // After join(), where the map has been adjusted: both sides look for what the other one sees.
  void match_both_ways(Map<S>& map, std::span<const KeyframeId> here, KeyframeId id) {
    around_.gather_around(map, id, here.size());
    take_in(map, here, place_);
    take_in(map, place_.keyframes, around_);
    update_covisibility(map, here);
    update_covisibility(map, place_.keyframes);
  }

  // Around the place that was joined last.
  [[nodiscard]] std::span<const KeyframeId> there() const noexcept { return place_.keyframes; }

 private:
  void take_in(Map<S>& map, std::span<const KeyframeId> keyframes, const LocalMap<S>& seen) {
    for (const KeyframeId k : keyframes) fusion.take_in(map, k, seen.points, seen.lines);
  }

  static void update_covisibility(Map<S>& map, std::span<const KeyframeId> keyframes) {
    for (const KeyframeId k : keyframes) map.update_covisibility(k);
  }

  template <class Seen, class Landmarks, class Fuse, class Observe>
  static void take_over(Map<S>& map, KeyframeId id, const std::vector<LandmarkId>& of_place, Seen seen,
                        const Landmarks& landmarks, Fuse fuse, Observe observe) {
    for (std::size_t i = 0; i < of_place.size(); ++i) {
      if (of_place[i] == kNone || !landmarks[map.index(of_place[i])].alive) continue;
      const LandmarkId own = (map.keyframes[map.index(id)].*seen)[i];
      if (own == of_place[i] || landmarks[map.index(of_place[i])].seen_by(id)) continue;
      if (own != kNone)
        fuse(own, of_place[i]);
      else
        observe(of_place[i], i);
    }
  }

  LocalMap<S> place_, around_;
};

}  // namespace sslam
