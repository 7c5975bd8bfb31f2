// SPDX-License-Identifier: BSD-3-Clause
// Covisibility: how many landmarks each two keyframes share, kept on both sides.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

// Counts anew what one keyframe shares with all others.
class Covisibility {
 public:
  void begin(std::size_t keyframe_count) { shared_.assign(keyframe_count, 0); }

  template <class Landmarks>
  void count(const std::vector<LandmarkId>& seen, const Landmarks& landmarks) {
    for (const LandmarkId id : seen)
      if (id != kNone)
        for (const Observation& o : landmarks[static_cast<std::size_t>(id)].observations)
          ++shared_[static_cast<std::size_t>(o.keyframe)];
  }

  template <Scalar S>
  void enter(KeyframeId id, std::vector<Keyframe<S>>& keyframes) {
    Keyframe<S>& kf = keyframes[static_cast<std::size_t>(id)];
    shared_[static_cast<std::size_t>(id)] = 0;
    kf.neighbours.clear();
    for (std::size_t other = 0; other < shared_.size(); ++other) {
      set_neighbour(keyframes[other].neighbours, {id, shared_[other]});
      if (shared_[other] > 0) kf.neighbours.push_back({static_cast<KeyframeId>(other), shared_[other]});
    }
    sort_by_shared(kf.neighbours);
  }

 private:
  std::vector<std::int32_t> shared_;  // by keyframe
};

}  // namespace sslam
