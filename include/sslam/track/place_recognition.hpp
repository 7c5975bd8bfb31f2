// SPDX-License-Identifier: BSD-3-Clause
// Place recognition: which keyframes show what a lost frame shows, by the landmarks that its features look
// like. There is no vocabulary: every feature is compared with every landmark.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sslam/track/match_points.hpp"

namespace sslam {

template <Scalar S>
class PlaceRecognition {
 public:
  int most = 3;           // keyframes to compare a frame with
  int max_distance = 60;  // bits between a landmark's descriptor and that of its feature
  S max_ratio = S(0.8);   // to the next best feature: landmarks that look like several do not vote
  int min_votes = 8;      // landmarks that a keyframe must share with the frame

  // Appends up to `most` keyframes to `ranked`, those that share most landmarks with the frame first.
  void rank(const Map<S>& map, const Frame<S>& frame, std::vector<KeyframeId>& ranked) {
    vote(map, frame);
    order_.clear();
    for (std::size_t k = 0; k < votes_.size(); ++k)
      if (votes_[k] >= min_votes) order_.push_back(static_cast<KeyframeId>(k));
    std::stable_sort(order_.begin(), order_.end(),
                     [&](KeyframeId a, KeyframeId b) { return votes_[map.index(a)] > votes_[map.index(b)]; });
    const auto count = std::min(order_.size(), static_cast<std::size_t>(std::max(most, 0)));
    ranked.insert(ranked.end(), order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(count));
  }

 private:
  void vote(const Map<S>& map, const Frame<S>& frame) {
    votes_.assign(map.keyframes.size(), 0);
    for (const PointLandmark<S>& landmark : map.points) {
      if (!landmark.alive) continue;
      BestTwo two;
      for (std::size_t i = 0; i < frame.points.size(); ++i)
        two.offer(hamming(landmark.descriptor, frame.points[i].descriptor), static_cast<std::int32_t>(i));
      if (!two.accepted(max_distance, max_ratio)) continue;
      for (const Observation& o : landmark.observations) ++votes_[map.index(o.keyframe)];
    }
  }

  std::vector<int> votes_;  // of each keyframe
  std::vector<KeyframeId> order_;
};

}  // namespace sslam
