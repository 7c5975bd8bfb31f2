// SPDX-License-Identifier: BSD-3-Clause
// Culling: a young landmark must prove itself, by being found where it should be seen and by further
// keyframes.
#pragma once

#include <vector>

#include "sslam/map/map.hpp"

namespace sslam {

template <Scalar S>
class LandmarkCulling {
 public:
  S min_found = S(0.25);             // share of the frames that should see a landmark and do
  int probation = 3;                 // keyframes for which a landmark is young
  std::size_t min_observations = 3;  // that a landmark must have when its probation ends

  // Tests the landmarks that are still young as of keyframe `now`; others have passed.
  void cull(Map<S>& map, KeyframeId now) {
    test(map.points, next_point_, young_points_, now, [&](LandmarkId id) { map.erase_point(id); });
    test(map.lines, next_line_, young_lines_, now, [&](LandmarkId id) { map.erase_line(id); });
  }

  void reset() { *this = LandmarkCulling{min_found, probation, min_observations}; }

  LandmarkCulling() = default;

 private:
  LandmarkCulling(S found, int keyframes, std::size_t observations)
      : min_found(found), probation(keyframes), min_observations(observations) {}

  template <class Landmarks, class Erase>
  void test(const Landmarks& landmarks, std::size_t& next, std::vector<LandmarkId>& young, KeyframeId now,
            Erase erase) {
    for (; next < landmarks.size(); ++next) young.push_back(static_cast<LandmarkId>(next));
    std::erase_if(young, [&](LandmarkId id) {
      const auto& landmark = landmarks[Map<S>::index(id)];
      if (!landmark.alive) return true;
      const int age = now - landmark.first_keyframe;
      const bool rarely_found = static_cast<S>(landmark.found) < min_found * static_cast<S>(landmark.visible);
      const bool too_few = age >= probation && landmark.observations.size() < min_observations;
      if (rarely_found || too_few) erase(id);
      return rarely_found || too_few || age >= probation;
    });
  }

  std::size_t next_point_ = 0, next_line_ = 0;  // first landmark not yet on probation
  std::vector<LandmarkId> young_points_, young_lines_;
};

}  // namespace sslam
