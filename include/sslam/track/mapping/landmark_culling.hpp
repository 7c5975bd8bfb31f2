// SPDX-License-Identifier: BSD-3-Clause
// Culling: a young landmark must prove itself, by being found where it should be seen and by further
// keyframes.
#pragma once

#include <algorithm>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/map/map.hpp"

namespace sslam {

template <Scalar S>
struct LandmarkCullingOptions {
  S min_found = S(0.25);             // share of the frames that should see a landmark and do
  int probation = 3;                 // keyframes for which a landmark is young
  std::size_t min_observations = 3;  // that a landmark must have when its probation ends

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("min_found", self.min_found, Unit::kShare, 0, 1, "of the frames that should see a landmark and do");
    visit("probation", self.probation, Unit::kCount, 0, 1e6, "keyframes for which a landmark is young");
    visit("min_observations", self.min_observations, Unit::kCount, 0, 1e6,
          "that a landmark must have when its probation ends");
  }
};
static_assert(Described<LandmarkCullingOptions<double>>);

template <Scalar S>
class LandmarkCulling {
 public:
  LandmarkCullingOptions<S> options;

  // Tests the landmarks that are still young as of keyframe `now`; others have passed.
  void cull(Map<S>& map, KeyframeId now) const;

 private:
  // Erasing takes a landmark out of `seen`, in place.
  template <class Landmarks, class Erase>
  void test(const std::vector<LandmarkId>& seen, const Landmarks& landmarks, KeyframeId now,
            Erase erase) const {
    for (const LandmarkId& id : seen) {
      if (id == kNone) continue;
      const auto& landmark = landmarks[Map<S>::index(id)];
      const int age = now - landmark.first_keyframe;
      if (age > options.probation) continue;
      const bool rarely_found =
          static_cast<S>(landmark.found) < options.min_found * static_cast<S>(landmark.visible);
      const bool too_few =
          age >= options.probation && landmark.observations.size() < options.min_observations;
      if (rarely_found || too_few) erase(LandmarkId{id});
    }
  }
};

template <Scalar S>
void LandmarkCulling<S>::cull(Map<S>& map, KeyframeId now) const {
  for (KeyframeId k = std::max(0, now - options.probation); k <= now; ++k) {
    const Keyframe<S>& keyframe = map.keyframes[map.index(k)];  // the creator of every young one is here
    test(keyframe.point_landmarks, map.points, now, [&](LandmarkId id) { map.erase_point(id); });
    test(keyframe.line_landmarks, map.lines, now, [&](LandmarkId id) { map.erase_line(id); });
  }
}

}  // namespace sslam
