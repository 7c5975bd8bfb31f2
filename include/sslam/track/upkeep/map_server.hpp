// SPDX-License-Identifier: BSD-3-Clause
// Keeps the map up away from the tracker: takes its keyframes in, one after the other, and gives out
// snapshots.
#pragma once

#include <algorithm>
#include <vector>

#include "sslam/track/contract/concepts.hpp"

namespace sslam {

template <Scalar S>
class MapServer {
 public:
  // From here on this is where the map grows.
  void begin(const Map<S>& map) {
    map_ = map;
    ++given_;
    scales_.assign(map.keyframes.size(), S(1));
    loops_ = 0;
  }

  template <class Mapping, class Loops>
  void take(KeyframePost<S>& post, Mapping& mapping, Loops& loops) {
    TrackedFrame<S>& frame = post.frame;
    const S scale = scales_[map_.index(post.reference)] / post.scale;
    SE3<S> frame_from_reference = post.frame_from_reference;
    frame_from_reference.translation *= scale;
    frame.cam_from_world = frame_from_reference * map_.pose(post.reference);
    forget_gone(frame.point_landmarks, map_.points, post.known);
    forget_gone(frame.line_landmarks, map_.lines, post.known);
    count(post.points, map_.points, post.known);
    count(post.lines, map_.lines, post.known);
    map_.world_from_manhattan = post.world_from_manhattan;
    scales_.push_back(scales_[map_.index(post.reference)]);
    const KeyframeId id = mapping.insert(map_, frame, post.median_depth * scale);
    const LoopAnswer<S> answer = loops.close(map_, id);
    if (!answer.closed) return;
    ++loops_;
    for (std::size_t k = 0; k < scales_.size(); ++k)
      scales_[k] *= answer.scale_at(static_cast<KeyframeId>(k));
  }

  // The snapshot's buffers are used again, and what it has of this map and never changes stays.
  void publish(MapSnapshot<S>& snapshot) const {
    if (snapshot.given == given_)
      snapshot.map.renew_from(map_);
    else
      snapshot.map = map_;
    snapshot.given = given_;
    snapshot.scales = scales_;
    snapshot.loops = loops_;
  }

 private:
  template <class Landmarks>
  static void count(const std::vector<Sightings>& seen, Landmarks& landmarks, std::size_t known) {
    for (const Sightings& s : seen) {
      if (!still_means(landmarks, s.landmark, known)) continue;
      landmarks[Map<S>::index(s.landmark)].visible += s.visible;
      landmarks[Map<S>::index(s.landmark)].found += s.found;
    }
  }

  Map<S> map_;
  std::vector<S> scales_;  // as in MapSnapshot
  int loops_ = 0;
  int given_ = 0;  // maps that were given to this server
};

}  // namespace sslam
