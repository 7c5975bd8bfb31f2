// SPDX-License-Identifier: BSD-3-Clause
// The part of the map around a frame: the keyframes that share landmarks with it, their neighbours, and what
// they see.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "sslam/map/keyframe_votes.hpp"
#include "sslam/map/map.hpp"

namespace sslam {

// Keeps its buffers, and its marks by generation: a frame costs no allocation once the map stops growing, and
// what it costs depends on what is around it, not on the map.
template <Scalar S>
class LocalMap {
 public:
  std::vector<KeyframeId> keyframes;  // most relevant first
  std::vector<LandmarkId> points;
  std::vector<LandmarkId> lines;

  // Keyframes that see the given landmarks, most of them first and ties to the newer, at most
  // `max_keyframes`; filled up with neighbours.
  void gather(const Map<S>& map, std::span<const LandmarkId> seen_points,
              std::span<const LandmarkId> seen_lines, std::size_t max_keyframes) {
    votes_.begin(map.keyframes.size());
    votes_.add(seen_points, map.points);
    votes_.add(seen_lines, map.lines);
    const std::span<const KeyframeId> voted = votes_.ranked(VoteTies::kNewerFirst);
    const auto most = voted.first(std::min(voted.size(), max_keyframes));
    keyframes.assign(most.begin(), most.end());
    add_neighbours(map, max_keyframes);
    collect(map);
  }

  // The given keyframe and its neighbours.
  void gather_around(const Map<S>& map, KeyframeId centre, std::size_t max_keyframes) {
    take_with_neighbours(map.keyframes[map.index(centre)], max_keyframes, keyframes);
    collect(map);
  }

 private:
  void add_neighbours(const Map<S>& map, std::size_t max_keyframes) {
    const std::size_t direct = keyframes.size();
    for (std::size_t i = 0; i < direct; ++i)
      for (const Neighbour& n : map.keyframes[map.index(keyframes[i])].neighbours) {
        if (keyframes.size() >= max_keyframes) return;
        if (std::find(keyframes.begin(), keyframes.end(), n.keyframe) == keyframes.end())
          keyframes.push_back(n.keyframe);
      }
  }

  void collect(const Map<S>& map) {
    ++generation_;
    point_marks_.resize(map.points.size(), 0);
    line_marks_.resize(map.lines.size(), 0);
    points.clear();
    lines.clear();
    for (const KeyframeId k : keyframes) {
      take_new(map.keyframes[map.index(k)].point_landmarks, point_marks_, points);
      take_new(map.keyframes[map.index(k)].line_landmarks, line_marks_, lines);
    }
  }

  void take_new(const std::vector<LandmarkId>& seen, std::vector<std::uint32_t>& marks,
                std::vector<LandmarkId>& out) const {
    for (const LandmarkId id : seen) {
      if (id == kNone || marks[Map<S>::index(id)] == generation_) continue;
      marks[Map<S>::index(id)] = generation_;
      out.push_back(id);
    }
  }

  KeyframeVotes votes_;
  std::vector<std::uint32_t> point_marks_;
  std::vector<std::uint32_t> line_marks_;
  std::uint32_t generation_ = 0;
};

}  // namespace sslam
