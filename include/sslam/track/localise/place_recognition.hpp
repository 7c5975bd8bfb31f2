// SPDX-License-Identifier: BSD-3-Clause
// Place recognition: which keyframes show what a frame shows, by the landmarks that its features look like.
// There is no vocabulary: a landmark votes when one feature looks like it, and no other nearly as much.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/map/keyframe_votes.hpp"
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
  // A landmark votes for the keyframes that see it.
  template <class Landmarks, class Seen, class Features>
  void vote(const Map<S>& map, const Landmarks& landmarks, const LookIndex& looks, Seen seen,
            const Features& features, std::span<const KeyframeId> apart_from) {
    if (candidates_.size() < landmarks.size()) candidates_.resize(landmarks.size());
    for (const KeyframeId k : apart_from)
      for (const LandmarkId id : map.keyframes[map.index(k)].*seen)
        if (id != kNone) touch(id).excluded = true;
    const int reach = telling_distance();
    for (std::size_t f = 0; f < features.size(); ++f)
      looks.near(features[f].descriptor, reach, [&](LandmarkId id, int distance) {
        Candidate& candidate = touch(id);
        if (!candidate.excluded) candidate.features.offer(distance, static_cast<std::int32_t>(f));
      });
    for (const LandmarkId id : touched_) {
      Candidate& candidate = candidates_[map.index(id)];
      if (!candidate.excluded && candidate.features.accepted(options.max_distance, options.max_ratio))
        votes_.add(landmarks[map.index(id)].observations);
      candidate = {};
    }
    touched_.clear();
  }

  // The most bits by which a feature can be the best for a landmark, or too good beside the best.
  [[nodiscard]] int telling_distance() const noexcept {
    int distance = 256;
    while (distance > options.max_distance &&
           options.max_ratio * static_cast<S>(distance) >= static_cast<S>(options.max_distance))
      --distance;
    return distance;
  }

  struct Candidate {
    BestTwo features;  // that look most like the landmark
    bool touched = false, excluded = false;
  };
  Candidate& touch(LandmarkId id) {
    Candidate& candidate = candidates_[Map<S>::index(id)];
    if (!candidate.touched) touched_.push_back(id);
    candidate.touched = true;
    return candidate;
  }

  std::vector<Candidate> candidates_;  // by landmark; untouched between two votes
  std::vector<LandmarkId> touched_;
  KeyframeVotes votes_;
};

template <Scalar S>
void PlaceRecognition<S>::rank(const Map<S>& map, const Frame<S>& frame, std::vector<KeyframeId>& ranked,
                               std::span<const KeyframeId> apart_from) {
  votes_.begin(map.keyframes.size());
  vote(map, map.points, map.point_looks(), &Keyframe<S>::point_landmarks, frame.points, apart_from);
  vote(map, map.lines, map.line_looks(), &Keyframe<S>::line_landmarks, frame.lines, apart_from);
  const std::span<const KeyframeId> voted = votes_.ranked(VoteTies::kOlderFirst);
  const auto most = static_cast<std::size_t>(std::max(options.most, 0));
  for (const KeyframeId k : voted.first(std::min(voted.size(), most))) {
    if (votes_.of(k) < options.min_votes) break;
    ranked.push_back(k);
  }
}

}  // namespace sslam
