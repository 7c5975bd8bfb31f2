// SPDX-License-Identifier: BSD-3-Clause
// Place recognition: which keyframes show what a frame shows, by the landmarks that its features look like.
// There is no vocabulary: a landmark votes when one feature looks like it, and no other nearly as much.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/track/matching/descriptor_buckets.hpp"
#include "sslam/track/matching/match_points.hpp"

namespace sslam {

template <Scalar S>
struct PlaceRecognitionOptions {
  int most = 3;           // keyframes to compare a frame with
  int max_distance = 50;  // bits between a landmark's descriptor and that of its feature
  S max_ratio = S(0.8);   // to the next best feature: landmarks that look like several do not vote
  int min_votes = 8;      // landmarks that a keyframe must share with the frame

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("candidates", self.most, Unit::kCount, 0, 1e6, "places to compare with; 0: none");
    visit("max_distance", self.max_distance, Unit::kCount, 0, 256,
          "bits between a landmark's descriptor and that of its feature");
    visit("max_ratio", self.max_ratio, Unit::kShare, 0, 1,
          "to the next best feature: landmarks that look like several do not vote");
    visit("min_votes", self.min_votes, Unit::kCount, 1, 1e6,
          "landmarks that a keyframe must share with the frame");
  }
};
static_assert(Described<PlaceRecognitionOptions<double>>);

template <Scalar S>
class PlaceRecognition {
 public:
  PlaceRecognitionOptions<S> options;

  // Appends up to `options.most` keyframes to `ranked`, those that share most landmarks with the frame first.
  // Keyframes in `apart_from` are not asked for, nor is what they see.
  void rank(const Map<S>& map, const Frame<S>& frame, std::vector<KeyframeId>& ranked,
            std::span<const KeyframeId> apart_from = {});

 private:
  template <class Landmarks, class Seen, class Features>
  void vote(const Map<S>& map, const Landmarks& landmarks, Seen seen, const Features& features,
            std::span<const KeyframeId> apart_from) {
    excluded_.assign(landmarks.size(), 0);
    for (const KeyframeId k : apart_from)
      for (const LandmarkId id : map.keyframes[map.index(k)].*seen)
        if (id != kNone) excluded_[map.index(id)] = 1;
    buckets_.build(features);
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      if (!landmarks[i].alive || excluded_[i] != 0 || !looks_like_one(landmarks[i].descriptor, features))
        continue;
      for (const Observation& o : landmarks[i].observations) ++votes_[map.index(o.keyframe)];
    }
  }

  // Among those that the buckets name, which leave out few that are close.
  template <class Features>
  [[nodiscard]] bool looks_like_one(const Descriptor& descriptor, const Features& features) const {
    BestTwo two;
    buckets_.near(descriptor, [&](std::int32_t f) {
      two.offer(hamming(descriptor, features[Map<S>::index(f)].descriptor), f);
    });
    return two.accepted(options.max_distance, options.max_ratio);
  }

  DescriptorBuckets buckets_;
  std::vector<std::uint8_t> excluded_;  // by landmark
  std::vector<int> votes_;              // of each keyframe
  std::vector<KeyframeId> order_;
};

template <Scalar S>
void PlaceRecognition<S>::rank(const Map<S>& map, const Frame<S>& frame, std::vector<KeyframeId>& ranked,
                               std::span<const KeyframeId> apart_from) {
  votes_.assign(map.keyframes.size(), 0);
  vote(map, map.points, &Keyframe<S>::point_landmarks, frame.points, apart_from);
  vote(map, map.lines, &Keyframe<S>::line_landmarks, frame.lines, apart_from);
  order_.clear();
  for (std::size_t k = 0; k < votes_.size(); ++k)
    if (votes_[k] >= options.min_votes) order_.push_back(static_cast<KeyframeId>(k));
  std::sort(order_.begin(), order_.end(), [&](KeyframeId a, KeyframeId b) {
    const int va = votes_[map.index(a)], vb = votes_[map.index(b)];
    return va != vb ? va > vb : a < b;
  });
  const auto count = std::min(order_.size(), static_cast<std::size_t>(std::max(options.most, 0)));
  ranked.insert(ranked.end(), order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace sslam
