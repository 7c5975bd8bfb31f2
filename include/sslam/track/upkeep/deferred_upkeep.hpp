// SPDX-License-Identifier: BSD-3-Clause
// Upkeep elsewhere: the tracker has a map of its own to track in, posts its keyframes to whoever keeps the
// map, and goes on in the newest snapshot of it. It never waits: a keyframe for which there is no room is not
// made.
#pragma once

#include <utility>
#include <vector>

#include "sslam/track/contract/concepts.hpp"
#include "sslam/track/contract/map_change.hpp"

namespace sslam {

// The way to a MapServer and back.
template <class T, class S, class Mapping, class Loops>
concept MapChannel = requires(T channel, const Map<S>& map, Mapping& mapping, Loops& loops,
                              KeyframePost<S> post, MapSnapshot<S>& snapshot) {
  channel.begin(map, mapping, loops);           // the server starts from a copy of the map
  { channel.running() } -> std::same_as<bool>;  // since begin(), until finish() or stop()
  { channel.room() } -> std::same_as<bool>;     // for one more keyframe
  channel.post(std::move(post));
  { channel.newest(snapshot) } -> std::same_as<bool>;  // swaps for a newer snapshot, if there is one
  channel.finish(snapshot);                            // the last one, when all posts are in it
  channel.stop();                                      // and drop what has not been done
};

// The map's visible and found counts are, on the tracker's side, what it has not posted yet.
template <Scalar S, class Channel>
class DeferredUpkeep {
 public:
  Channel channel;

  // The frame joins the tracker's own map as it is; what mapping makes of it comes with a later snapshot.
  template <class Mapping, class Loops>
  requires MapChannel<Channel, S, Mapping, Loops> KeyframeId insert(Map<S>& map, TrackedFrame<S>& frame,
                                                                    KeyframeId reference, S median_depth,
                                                                    Mapping& mapping, Loops& loops) {
    if (!channel.running()) hand_over(map, mapping, loops);
    if (!channel.room()) {
      ++refused_;
      return kNone;
    }
    channel.post(write_post(map, frame, reference, median_depth));
    const KeyframeId id = map.add_keyframe(frame.to_keyframe());
    add_own(id, reference);
    return id;
  }

  // The server looks for loops.
  template <class Loops>
  LoopAnswer<S> close(Map<S>&, KeyframeId, Loops&) {
    return {};
  }

  // Takes the newest snapshot, if there is one. The answer is valid until the next call of any function here.
  const MapChange<S>* renew(Map<S>& map) {
    if (!channel.running() || !channel.newest(snapshot_)) return nullptr;
    adopt(map);
    clear_counts(map);
    count_again(map);
    return &change_;
  }

  // Waits for all that was posted, and takes the map over for good.
  const MapChange<S>* finish(Map<S>& map) {
    if (!channel.running()) return nullptr;
    channel.finish(snapshot_);
    adopt(map);
    count_again(map);
    return &change_;
  }

  // The map is given up.
  void forget() { channel.stop(); }

  // Keyframes that were not made because there was no room.
  [[nodiscard]] int refused() const noexcept { return refused_; }

 private:
  // A keyframe that no snapshot has yet.
  struct Own {
    KeyframeId id, reference;
  };

  template <class Mapping, class Loops>
  void hand_over(Map<S>& map, Mapping& mapping, Loops& loops) {
    channel.begin(map, mapping, loops);
    clear_counts(map);
    own_.clear();
    known_ = map.keyframes.size();
    scales_.assign(known_, S(1));
    loops_ = 0;
  }

  KeyframePost<S> write_post(Map<S>& map, TrackedFrame<S>& frame, KeyframeId reference, S median_depth) {
    KeyframePost<S> post;
    NormalField normals;
    std::swap(normals, frame.frame.normals);  // they served the rotation stage, and they are large
    post.frame = frame;
    std::swap(normals, frame.frame.normals);
    post.reference = reference;
    post.frame_from_reference = frame.cam_from_world * map.pose(reference).inverse();
    post.median_depth = median_depth;
    post.scale = scales_[map.index(reference)];
    post.known = known_;
    post.world_from_manhattan = map.world_from_manhattan;
    move_counts(map.points, post.points);
    move_counts(map.lines, post.lines);
    return post;
  }

  void add_own(KeyframeId id, KeyframeId reference) {
    own_.push_back({id, reference});
    scales_.push_back(scales_[Map<S>::index(reference)]);
  }

  // The snapshot's map and the tracker's change places, and what the snapshot lacks is added to it.
  void adopt(Map<S>& map) {
    std::swap(map, snapshot_.map);
    std::swap(scales_, snapshot_.scales);
    map.world_from_manhattan = snapshot_.map.world_from_manhattan;
    const std::size_t known = std::exchange(known_, map.keyframes.size());
    const bool loop_closed = std::exchange(loops_, snapshot_.loops) != snapshot_.loops;
    change_ = {&snapshot_.map, &map, &snapshot_.scales, &scales_, known, loop_closed};
    std::vector<Own> rest;
    std::swap(rest, own_);
    for (const Own& own : rest) {
      if (map.index(own.id) < known_) continue;
      // Its features move on; its pose also stays in the map before, which the change goes by.
      Keyframe<S> keyframe = std::move(snapshot_.map.keyframes[map.index(own.id)]);
      keyframe.cam_from_world = change_.pose(own.reference, keyframe.cam_from_world);
      std::vector<LandmarkId> points = keyframe.point_landmarks, lines = keyframe.line_landmarks;
      change_.forget_gone_matches(points, lines);
      map.add_keyframe(std::move(keyframe).seeing(std::move(points), std::move(lines)));
      add_own(own.id, own.reference);
    }
  }

  static void clear_counts(Map<S>& map) {
    for (auto& point : map.points) point.visible = point.found = 0;
    for (auto& line : map.lines) line.visible = line.found = 0;
  }

  // What the tracker had not posted when it took the snapshot remains to be told.
  void count_again(Map<S>& map) const {
    count_again(snapshot_.map.points, map.points);
    count_again(snapshot_.map.lines, map.lines);
  }
  template <class Landmarks>
  void count_again(const Landmarks& before, Landmarks& now) const {
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (!still_means(now, static_cast<LandmarkId>(i), change_.known)) continue;
      now[i].visible += before[i].visible;
      now[i].found += before[i].found;
    }
  }

  template <class Landmarks>
  static void move_counts(Landmarks& landmarks, std::vector<Sightings>& post) {
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      auto& landmark = landmarks[i];
      if (landmark.visible == 0 && landmark.found == 0) continue;
      post.push_back(
          {static_cast<LandmarkId>(i), std::exchange(landmark.visible, 0), std::exchange(landmark.found, 0)});
    }
  }

  MapSnapshot<S> snapshot_;  // after adopt(): what the tracker had before
  MapChange<S> change_;
  std::vector<Own> own_;   // oldest first
  std::vector<S> scales_;  // as in MapSnapshot
  std::size_t known_ = 0;  // keyframes of the snapshot that the tracker's map began with
  int loops_ = 0;
  int refused_ = 0;
};

}  // namespace sslam
