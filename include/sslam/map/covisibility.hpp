// SPDX-License-Identifier: BSD-3-Clause
// Covisibility: how many landmarks each two keyframes share, kept on both sides.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "sslam/map/keyframe.hpp"

namespace sslam {

inline void sort_by_shared(std::vector<Neighbour>& neighbours) {
  std::stable_sort(neighbours.begin(), neighbours.end(),
                   [](const Neighbour& a, const Neighbour& b) { return a.shared > b.shared; });
}

// Most shared first; one that shares nothing goes.
inline void set_neighbour(std::vector<Neighbour>& neighbours, Neighbour neighbour) {
  std::erase_if(neighbours, [&](const Neighbour& n) { return n.keyframe == neighbour.keyframe; });
  if (neighbour.shared == 0) return;
  neighbours.push_back(neighbour);
  sort_by_shared(neighbours);
}

// Counts anew what one keyframe shares with all others. What that costs grows with what it sees, not with the
// map.
class Covisibility {
 public:
  void begin(std::size_t keyframe_count) { shared_.resize(keyframe_count, 0); }

  template <class Landmarks>
  void count(const std::vector<LandmarkId>& seen, const Landmarks& landmarks) {
    for (const LandmarkId id : seen)
      if (id != kNone)
        for (const Observation& o : landmarks[static_cast<std::size_t>(id)].observations)
          if (shared_[static_cast<std::size_t>(o.keyframe)]++ == 0) others_.push_back(o.keyframe);
  }

  // Those that were neighbours, on both sides, may be so no longer.
  template <Scalar S>
  void enter(KeyframeId id, std::vector<Keyframe<S>>& keyframes) {
    Keyframe<S>& kf = keyframes[static_cast<std::size_t>(id)];
    for (const Neighbour& n : kf.neighbours)
      if (shared_[static_cast<std::size_t>(n.keyframe)] == 0) others_.push_back(n.keyframe);
    std::sort(others_.begin(), others_.end());
    kf.neighbours.clear();
    for (const KeyframeId other : others_) {
      const std::int32_t shared = std::exchange(shared_[static_cast<std::size_t>(other)], 0);
      if (other == id) continue;
      set_neighbour(keyframes[static_cast<std::size_t>(other)].neighbours, {id, shared});
      if (shared > 0) kf.neighbours.push_back({other, shared});
    }
    others_.clear();
    sort_by_shared(kf.neighbours);
  }

 private:
  std::vector<std::int32_t> shared_;  // by keyframe; all 0 between two counts
  std::vector<KeyframeId> others_;    // in question
};

}  // namespace sslam
