// SPDX-License-Identifier: BSD-3-Clause
// Keyframe culling: a keyframe whose landmarks others see as well adds cost and memory, and little else
// (Mur-Artal, Montiel, Tardos, ORB-SLAM, T-RO 2015, section VI-E).
#pragma once

#include <algorithm>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/map/map.hpp"

namespace sslam {

template <Scalar S>
struct KeyframeCullingOptions {
  S redundant_share = S(0.9);  // of a keyframe's landmarks, seen well elsewhere: it goes; over 1: never
  int min_others = 3;          // other keyframes that must see a landmark, points from as near
  int spared = 5;              // newest keyframes, which still wait for their neighbours

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("redundant_share", self.redundant_share, Unit::kNumber, 0, 2,
          "of a keyframe's landmarks, seen well elsewhere: it is removed (over 1: never)");
    visit("min_others", self.min_others, Unit::kCount, 1, 1e6,
          "other keyframes that must see a landmark as well");
    visit("spared", self.spared, Unit::kCount, 0, 1e6, "newest keyframes that always stay");
  }
};
static_assert(Described<KeyframeCullingOptions<double>>);

template <Scalar S>
class KeyframeCulling {
 public:
  KeyframeCullingOptions<S> options;

  // Removes redundant keyframes among the neighbours of `now`. The first map's two are never removed: they
  // hold place and scale.
  void cull(Map<S>& map, KeyframeId now);

 private:
  [[nodiscard]] bool is_redundant(const Map<S>& map, const Keyframe<S>& keyframe) const {
    std::ptrdiff_t held = 0, elsewhere = 0;
    const auto judge = [&](const std::vector<LandmarkId>& seen, const auto& landmarks, auto as_good) {
      for (std::size_t i = 0; i < seen.size(); ++i) {
        if (seen[i] == kNone) continue;
        ++held;
        const auto& observations = landmarks[map.index(seen[i])].observations;
        const auto others =
            std::count_if(observations.begin(), observations.end(),
                          [&](const Observation& o) { return o.keyframe != keyframe.id && as_good(o, i); });
        elsewhere += others >= options.min_others;
      }
    };
    const auto octave = [](const Keyframe<S>& kf, std::size_t i) { return kf.frame.points[i].octave; };
    judge(keyframe.point_landmarks, map.points, [&](const Observation& o, std::size_t i) {
      return octave(map.keyframes[map.index(o.keyframe)], map.index(o.feature)) <= octave(keyframe, i) + 1;
    });
    judge(keyframe.line_landmarks, map.lines, [](const Observation&, std::size_t) { return true; });
    return held > 0 && static_cast<S>(elsewhere) >= options.redundant_share * static_cast<S>(held);
  }

  std::vector<Neighbour> candidates_;
};

template <Scalar S>
void KeyframeCulling<S>::cull(Map<S>& map, KeyframeId now) {
  candidates_ = map.keyframes[map.index(now)].neighbours;
  for (const Neighbour& candidate : candidates_) {
    const KeyframeId id = candidate.keyframe;
    if (id < 2 || id + options.spared > now || !is_redundant(map, map.keyframes[map.index(id)])) continue;
    map.erase_keyframe(id, map.keyframes[map.index(id)].neighbours.front().keyframe);
  }
}

}  // namespace sslam
