// SPDX-License-Identifier: BSD-3-Clause
// Votes for keyframes: each landmark of a set votes for those that observe it, and the keyframes with most
// votes share most with the set.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sslam/map/landmark.hpp"

namespace sslam {

// Which of two keyframes with as many votes comes first.
enum class VoteTies : std::uint8_t { kNewerFirst, kOlderFirst };

// Keeps its buffers: a count allocates nothing once the map stops growing, and costs what its votes cost, not
// what the map would.
class KeyframeVotes {
 public:
  // A new count, without any votes yet, for keyframes 0 to keyframe_count - 1.
  void begin(std::size_t keyframe_count) {
    for (const KeyframeId k : voted_) votes_[index(k)] = 0;
    voted_.clear();
    votes_.resize(keyframe_count, 0);
  }

  void add(KeyframeId keyframe) {
    if (votes_[index(keyframe)]++ == 0) voted_.push_back(keyframe);
  }

  void add(const std::vector<Observation>& observations) {
    for (const Observation& o : observations) add(o.keyframe);
  }

  // Of each landmark in the list, which may have kNone among them.
  template <class Landmarks>
  void add(std::span<const LandmarkId> seen, const Landmarks& landmarks) {
    for (const LandmarkId id : seen)
      if (id != kNone) add(landmarks[index(id)].observations);
  }

  [[nodiscard]] std::int32_t of(KeyframeId keyframe) const { return votes_[index(keyframe)]; }

  // Those with votes, most votes first; until the next call of any of these.
  [[nodiscard]] std::span<const KeyframeId> ranked(VoteTies ties) {
    std::sort(voted_.begin(), voted_.end(), [&](KeyframeId a, KeyframeId b) {
      if (of(a) != of(b)) return of(a) > of(b);
      return ties == VoteTies::kNewerFirst ? a > b : a < b;
    });
    return voted_;
  }

 private:
  [[nodiscard]] static constexpr std::size_t index(std::int32_t id) noexcept {
    return static_cast<std::size_t>(id);
  }

  std::vector<std::int32_t> votes_;  // by keyframe
  std::vector<KeyframeId> voted_;    // with votes
};

}  // namespace sslam
