// SPDX-License-Identifier: BSD-3-Clause
// Covisibility: how many landmarks each two keyframes share, kept on both sides.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sslam/map/keyframe.hpp"
#include "sslam/map/keyframe_votes.hpp"

namespace sslam {

// Most shared first; one that shares nothing goes.
inline void set_neighbour(std::vector<Neighbour>& neighbours, Neighbour neighbour) {
  std::erase_if(neighbours, [&](const Neighbour& n) { return n.keyframe == neighbour.keyframe; });
  if (neighbour.shared == 0) return;
  neighbours.push_back(neighbour);
  std::stable_sort(neighbours.begin(), neighbours.end(),
                   [](const Neighbour& a, const Neighbour& b) { return a.shared > b.shared; });
}

// The keyframe and those that share most with it, at most `most` in all.
template <Scalar S>
void take_with_neighbours(const Keyframe<S>& keyframe, std::size_t most, std::vector<KeyframeId>& taken) {
  taken.assign(1, keyframe.id);
  for (const Neighbour& n : keyframe.neighbours) {
    if (taken.size() >= most) break;
    taken.push_back(n.keyframe);
  }
}

// Counts anew what one keyframe shares with all others. What that costs grows with what it sees, not with the
// map.
class Covisibility {
 public:
  template <Scalar S, class Points, class Lines>
  void renew(KeyframeId id, const Points& points, const Lines& lines, std::vector<Keyframe<S>>& keyframes) {
    const auto neighbours_of = [&](KeyframeId k) -> std::vector<Neighbour>& {
      return keyframes[static_cast<std::size_t>(k)].neighbours;
    };
    Keyframe<S>& kf = keyframes[static_cast<std::size_t>(id)];
    shared_.begin(keyframes.size());
    shared_.add(kf.point_landmarks.values(), points);
    shared_.add(kf.line_landmarks.values(), lines);
    // Those that were neighbours, on both sides, may be so no longer.
    for (const Neighbour& n : kf.neighbours)
      if (shared_.of(n.keyframe) == 0) set_neighbour(neighbours_of(n.keyframe), {id, 0});
    kf.neighbours.clear();
    for (const KeyframeId other : shared_.ranked(VoteTies::kOlderFirst)) {
      if (other == id) continue;
      set_neighbour(neighbours_of(other), {id, shared_.of(other)});
      kf.neighbours.push_back({other, shared_.of(other)});
    }
  }

 private:
  KeyframeVotes shared_;  // landmarks
};

}  // namespace sslam
