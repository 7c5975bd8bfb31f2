// SPDX-License-Identifier: BSD-3-Clause
// Loop detection: a keyframe is looked for where the map lies without being connected with it. If its place
// is found there, the depths of what it sees twice say by how much the scale has drifted in between.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "sslam/core/median.hpp"
#include "sslam/geometry/sim3.hpp"
#include "sslam/track/fallback.hpp"
#include "sslam/track/place_recognition.hpp"
#include "sslam/track/refinement.hpp"

namespace sslam {

template <Scalar S>
struct Loop {
  KeyframeId place = kNone;  // the keyframe that was met again
  Sim3<S> cam_from_world;    // of the keyframe that closes the loop, in the world as it is around `place`
  std::vector<LandmarkId> point_landmarks;  // of that place, one for each of its features or kNone
  std::vector<LandmarkId> line_landmarks;
  int matches = 0;
};

template <Scalar S>
class LoopDetection {
 public:
  PlaceRecognition<S> places;  // places.most: keyframes to try; 0: no loop is ever found
  FeatureFallback<S> alignment;
  LocalMapRefinement<S> refinement;
  S max_turn = radians(S(15));  // of the world between both places; structure lets it drift by much less
  S depth_agreement = S(0.15);  // between the ratios of two depths of one feature and their median
  S min_depth_share = S(0.6);   // of the features that stand twice in the map and agree on the ratio
  int min_depths = 10;          // of them
  S max_scale_drift = S(2);     // factor

  LoopDetection() {
    places.most = 2;
    places.min_votes = 20;
    refinement.acceptance.min_inliers = 25;
  }

  [[nodiscard]] std::optional<Loop<S>> find(Map<S>& map, KeyframeId id) {
    const Keyframe<S>& keyframe = map.keyframes[map.index(id)];
    connected_.assign(1, id);
    for (const Neighbour& n : keyframe.neighbours) connected_.push_back(n.keyframe);
    candidates_.clear();
    if (places.most > 0) places.rank(map, keyframe.frame, candidates_, connected_);
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      // Next to a keyframe that was tried in vain is the same place.
      if (i > 0 && covisible(map.keyframes[map.index(candidates_[0])], candidates_[i])) continue;
      if (auto loop = verify(map, keyframe, candidates_[i])) return loop;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] static bool covisible(const Keyframe<S>& keyframe, KeyframeId other) {
    return std::any_of(keyframe.neighbours.begin(), keyframe.neighbours.end(),
                       [&](const Neighbour& n) { return n.keyframe == other; });
  }

  [[nodiscard]] std::optional<Loop<S>> verify(Map<S>& map, const Keyframe<S>& keyframe, KeyframeId place) {
    view_.frame = keyframe.frame;
    view_.grid.build(view_.frame.points, view_.frame.width, view_.frame.height);
    view_.cam_from_world = map.keyframes[map.index(place)].cam_from_world;
    if (!alignment.track_keyframe(map, place, nullptr, view_).ok()) return std::nullopt;
    const PoseEstimate<S> estimate = refinement.refine(map, nullptr, view_);
    if (!estimate.ok()) return std::nullopt;
    const SO3<S> turn = view_.cam_from_world.rotation.inverse() * keyframe.cam_from_world.rotation;
    if (!(turn.log().norm() < max_turn)) return std::nullopt;
    const std::optional<S> ratio = depth_ratio(map, keyframe);
    if (!ratio) return std::nullopt;
    const SE3<S>& pose = view_.cam_from_world;
    return Loop<S>{place,
                   {pose.rotation, pose.translation / *ratio, 1 / *ratio},
                   view_.point_landmarks,
                   view_.line_landmarks,
                   estimate.point_inliers + estimate.line_inliers};
  }

  // Depth of a feature by the landmark it has at the place over that by the landmark it has where the
  // keyframe stands.
  [[nodiscard]] std::optional<S> depth_ratio(const Map<S>& map, const Keyframe<S>& keyframe) {
    ratios_.clear();
    const auto compare = [&](const auto& here, const auto& there, auto depth) {
      for (std::size_t i = 0; i < here.size(); ++i) {
        if (here[i] == kNone || there[i] == kNone || here[i] == there[i]) continue;
        const S old_depth = depth(view_.cam_from_world, there[i], i);
        const S new_depth = depth(keyframe.cam_from_world, here[i], i);
        if (old_depth > 0 && new_depth > 0) ratios_.push_back(old_depth / new_depth);
      }
    };
    compare(keyframe.point_landmarks, view_.point_landmarks,
            [&](const SE3<S>& cam_from_world, LandmarkId id, std::size_t) {
              return (cam_from_world * map.points[map.index(id)].position).z();
            });
    compare(keyframe.line_landmarks, view_.line_landmarks,
            [&](const SE3<S>& cam_from_world, LandmarkId id, std::size_t i) {
              const Segment2<S>& segment = keyframe.frame.lines[i].segment;
              const Vec2<S> middle = (segment.start + segment.end) / 2;
              const Vec3<S> ray = keyframe.frame.pinhole.unproject(middle).normalized();
              const Line3<S> line = transform(cam_from_world, map.lines[map.index(id)].line);
              return line.closest_to_ray(Vec3<S>::Zero(), ray).z();
            });
    if (static_cast<int>(ratios_.size()) < min_depths) return std::nullopt;
    const S drift = median<S>(ratios_);
    const auto agree = std::count_if(ratios_.begin(), ratios_.end(), [&](S ratio) {
      return std::abs(std::log(ratio / drift)) < depth_agreement;
    });
    const bool agreed = static_cast<S>(agree) >= min_depth_share * static_cast<S>(ratios_.size());
    if (!agreed || !(std::abs(std::log(drift)) < std::log(max_scale_drift))) return std::nullopt;
    return drift;
  }

  std::vector<KeyframeId> connected_, candidates_;
  TrackedFrame<S> view_;  // the keyframe, as a frame at the place
  std::vector<S> ratios_;
};

}  // namespace sslam
