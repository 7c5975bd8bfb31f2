// SPDX-License-Identifier: BSD-3-Clause
// Loop detection: a keyframe is looked for where the map lies without being connected with it, or in another
// map. If its place is found there, the depths of what it sees twice say by how much the scale differs.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "sslam/core/median.hpp"
#include "sslam/core/parameter.hpp"
#include "sslam/manhattan/nearest_frame.hpp"
#include "sslam/track/localise/fallback.hpp"
#include "sslam/track/localise/place_recognition.hpp"
#include "sslam/track/localise/refinement.hpp"
#include "sslam/track/loops/place_confirmation.hpp"

namespace sslam {

template <Scalar S>
struct LoopDetectionOptions {
  S max_turn = radians(S(15));  // of the world between both places; structure lets it drift by much less
  S depth_agreement = S(0.15);  // between the ratios of two depths of one feature and their median
  S min_depth_share = S(0.6);   // of the features that stand twice in the map and agree on the ratio
  int min_depths = 10;          // of them
  S max_scale_drift = S(2);     // factor

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_turn", self.max_turn, Unit::kDegrees, 0, 180, "of the world that a loop may undo");
    visit("depth_agreement", self.depth_agreement, Unit::kNumber, 0, 10,
          "between the ratios of two depths of one feature and their median, logarithmic");
    visit("min_depth_share", self.min_depth_share, Unit::kShare, 0, 1,
          "of the features that stand twice in the map, that agree on the ratio");
    visit("min_depths", self.min_depths, Unit::kCount, 1, 10000, "features that stand twice in the map");
    visit("max_scale_drift", self.max_scale_drift, Unit::kNumber, 1, 100, "that a loop may undo, factor");
  }
};
static_assert(Described<LoopDetectionOptions<double>>);

template <Scalar S>
class LoopDetection {
 public:
  LoopDetectionOptions<S> options;
  PlaceRecognition<S> places;  // places.options.most: keyframes to try; 0: no loop is ever found
  PlaceConfirmation<S> confirmation;
  FeatureFallback<S> alignment;
  LocalMapRefinement<S> refinement;

  // With those of the stages that it asks.
  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("", self.options, visit);
    visit_stage("", self.places, visit);
    visit_stage("", self.refinement, visit);
    visit_stage("alignment.", self.alignment, visit);
    visit_stage("confirmation.", self.confirmation, visit);
  }

  LoopDetection() {
    places.options.most = 2;
    places.options.min_votes = 20;
    refinement.options.acceptance.min_inliers = 25;
  }

  // The place of a keyframe of `here` in `there`, which may be the same map.
  [[nodiscard]] std::optional<Loop<S>> find(const Map<S>& here, KeyframeId id, const Map<S>& there);

  // Whether that place bears out the one met before, `first`, which becomes the newer one where they
  // contradict each other.
  [[nodiscard]] bool confirmed(const Keyframe<S>& keyframe, const Map<S>& there, const Loop<S>& loop,
                               std::optional<PlaceMatch<S>>& first) const {
    return confirmation.confirmed(keyframe, there, loop, first);
  }

 private:
  [[nodiscard]] static bool covisible(const Keyframe<S>& keyframe, KeyframeId other) {
    return std::any_of(keyframe.neighbours.begin(), keyframe.neighbours.end(),
                       [&](const Neighbour& n) { return n.keyframe == other; });
  }

  [[nodiscard]] std::optional<Loop<S>> verify(const Map<S>& here, const Keyframe<S>& keyframe,
                                              const Map<S>& there, KeyframeId place) {
    view_.frame = keyframe.frame;
    view_.grid.build(view_.frame.points, view_.frame.width, view_.frame.height);
    view_.cam_from_world = there.keyframes[there.index(place)].cam_from_world;
    if (!alignment.track_keyframe(there, place, nullptr, view_).ok()) return std::nullopt;
    const PoseEstimate<S> estimate = refinement.refine_uncounted(there, nullptr, view_);
    if (!estimate.ok()) return std::nullopt;
    const SO3<S> turn = view_.cam_from_world.rotation.inverse() * keyframe.cam_from_world.rotation;
    if (!agrees(here, there, turn)) return std::nullopt;
    const std::optional<S> ratio = depth_ratio(here, keyframe, there);
    if (!ratio) return std::nullopt;
    const SE3<S>& pose = view_.cam_from_world;
    return Loop<S>{place,
                   {pose.rotation, pose.translation / *ratio, 1 / *ratio},
                   view_.point_landmarks,
                   view_.line_landmarks,
                   estimate.point_inliers + estimate.line_inliers};
  }

  // One map turns by little on the way round a loop. Two may stand anyhow to each other, but if both know a
  // Manhattan frame, one of them must be the same.
  [[nodiscard]] bool agrees(const Map<S>& here, const Map<S>& there, const SO3<S>& there_from_here) const {
    if (&here == &there) return there_from_here.log().norm() < options.max_turn;
    const auto& known = there.world_from_manhattan;
    return known.empty() || here.world_from_manhattan.empty() ||
           std::any_of(here.world_from_manhattan.begin(), here.world_from_manhattan.end(),
                       [&](const SO3<S>& frame) {
                         return nearest_frame(known, there_from_here * frame, options.max_turn).has_value();
                       });
  }

  // Depth of a feature by the landmark it has at the place over that by the landmark it has where the
  // keyframe stands.
  [[nodiscard]] std::optional<S> depth_ratio(const Map<S>& here, const Keyframe<S>& keyframe,
                                             const Map<S>& there) {
    const bool same = &here == &there;
    ratios_.clear();
    const auto compare = [&](const auto& own, const auto& of_place, auto depth) {
      for (std::size_t i = 0; i < own.size(); ++i) {
        if (own[i] == kNone || of_place[i] == kNone || (same && own[i] == of_place[i])) continue;
        const S old_depth = depth(there, view_.cam_from_world, of_place[i], i);
        const S new_depth = depth(here, keyframe.cam_from_world, own[i], i);
        if (old_depth > 0 && new_depth > 0) ratios_.push_back(old_depth / new_depth);
      }
    };
    compare(keyframe.point_landmarks, view_.point_landmarks,
            [](const Map<S>& map, const SE3<S>& cam_from_world, LandmarkId id, std::size_t) {
              return (cam_from_world * map.points[map.index(id)].position).z();
            });
    compare(keyframe.line_landmarks, view_.line_landmarks,
            [&](const Map<S>& map, const SE3<S>& cam_from_world, LandmarkId id, std::size_t i) {
              const Segment2<S>& segment = keyframe.frame.lines[i].segment;
              const Vec3<S> ray = keyframe.frame.pinhole.unproject(segment.midpoint()).normalized();
              const Line3<S> line = transform(cam_from_world, map.lines[map.index(id)].line);
              return line.closest_to_ray(Vec3<S>::Zero(), ray).z();
            });
    if (static_cast<int>(ratios_.size()) < options.min_depths) return std::nullopt;
    const S drift = median<S>(ratios_);
    const auto agree = std::count_if(ratios_.begin(), ratios_.end(), [&](S ratio) {
      return std::abs(std::log(ratio / drift)) < options.depth_agreement;
    });
    if (static_cast<S>(agree) < options.min_depth_share * static_cast<S>(ratios_.size())) return std::nullopt;
    // The scales of two maps are unrelated.
    if (same && !(std::abs(std::log(drift)) < std::log(options.max_scale_drift))) return std::nullopt;
    return drift;
  }

  std::vector<KeyframeId> connected_, candidates_;
  TrackedFrame<S> view_;  // the keyframe, as a frame at the place
  std::vector<S> ratios_;
};

template <Scalar S>
std::optional<Loop<S>> LoopDetection<S>::find(const Map<S>& here, KeyframeId id, const Map<S>& there) {
  const Keyframe<S>& keyframe = here.keyframes[here.index(id)];
  connected_.clear();
  if (&here == &there) {
    connected_.push_back(id);
    for (const Neighbour& n : keyframe.neighbours) connected_.push_back(n.keyframe);
  }
  candidates_.clear();
  if (places.options.most > 0) places.rank(there, keyframe.frame, candidates_, connected_);
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    // Next to a keyframe that was tried in vain is the same place.
    if (i > 0 && covisible(there.keyframes[there.index(candidates_[0])], candidates_[i])) continue;
    if (auto loop = verify(here, keyframe, there, candidates_[i])) return loop;
  }
  return std::nullopt;
}
static_assert(PlaceFinder<LoopDetection<double>, double>);

}  // namespace sslam
