// SPDX-License-Identifier: BSD-3-Clause
// Tracking without a Manhattan frame: first from the last two frames, then from the last keyframe by
// descriptors (Li et al. 2020, section V-C).
#pragma once

#include "sslam/core/parameter.hpp"
#include "sslam/track/localise/translation.hpp"
#include "sslam/track/matching/mutual_matcher.hpp"

namespace sslam {

template <Scalar S>
struct FallbackOptions {
  MatchOptions<S> match;
  PoseAcceptance<S> acceptance;
  PoseRefinementOptions<S> solver;
  S widening = 2;  // of the search windows when the first try fails
  PointMatchOptions<S> descriptor_match{.max_distance = 50, .max_ratio = S(0.75)};

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("", self.match, visit);
    visit_within("", self.acceptance, visit);
    visit_within("solver.", self.solver, visit);
    visit("widening", self.widening, Unit::kNumber, 1, 100, "of the windows at the second try");
    visit_within("keyframe.", self.descriptor_match, visit);
  }
};
static_assert(Described<FallbackOptions<double>>);

template <Scalar S>
class FeatureFallback {
 public:
  FallbackOptions<S> options;

  // In: the frame's pose is the prediction. Out: the solved pose and its inlying matches; unchanged pose on
  // failure.
  [[nodiscard]] PoseEstimate<S> track(const Map<S>& map, const RecentLandmarks<S>& recent,
                                      const RotationPrior<S>* prior, TrackedFrame<S>& frame);

  // Tracks against one keyframe: its points by descriptors, then its lines by reprojection.
  [[nodiscard]] PoseEstimate<S> track_keyframe(const Map<S>& map, KeyframeId id,
                                               const RotationPrior<S>* prior, TrackedFrame<S>& frame);

 private:
  void match_keyframe_points(const Keyframe<S>& keyframe, TrackedFrame<S>& frame) {
    frame.forget_matches();
    // Every feature of the frame is a candidate: after a loss nothing is known about where to look.
    matcher_.match(
        keyframe.frame.points, frame.frame.points, options.descriptor_match,
        [&](std::int32_t i, auto visit) {
          if (keyframe.point_landmarks[Map<S>::index(i)] == kNone) return;
          for (std::size_t j = 0; j < frame.frame.points.size(); ++j) visit(static_cast<std::int32_t>(j));
        },
        pairs_);
    keep_consistent_rotation<S>(keyframe.frame.points, frame.frame.points, pairs_);
    for (const IndexPair& p : pairs_)
      frame.point_landmarks[Map<S>::index(p.second)] = keyframe.point_landmarks[Map<S>::index(p.first)];
  }

  [[nodiscard]] PoseEstimate<S> solve(const Map<S>& map, const RotationPrior<S>* prior,
                                      TrackedFrame<S>& frame) {
    matches_.gather(map, frame);
    if (static_cast<int>(matches_.size()) < options.acceptance.min_inliers) return {};
    SE3<S> pose = frame.cam_from_world;
    const auto summary = refine_pose<S>(frame.frame.pinhole, matches_.points, matches_.lines, pose,
                                        options.solver, matches_.point_inliers, matches_.line_inliers, prior);
    return settle_pose(summary, pose, options.acceptance, matches_, frame);
  }

  Correspondences<S> matches_;
  RecentLandmarks<S> recent_;
  MutualMatcher matcher_;
  std::vector<IndexPair> pairs_;
};

template <Scalar S>
PoseEstimate<S> FeatureFallback<S>::track(const Map<S>& map, const RecentLandmarks<S>& recent,
                                          const RotationPrior<S>* prior, TrackedFrame<S>& frame) {
  PoseEstimate<S> estimate;
  for (const S width : {S(1), options.widening}) {
    match_recent(map, recent, width, options.match, frame);
    estimate = solve(map, prior, frame);
    if (estimate.ok()) return estimate;
  }
  return estimate;
}

template <Scalar S>
PoseEstimate<S> FeatureFallback<S>::track_keyframe(const Map<S>& map, KeyframeId id,
                                                   const RotationPrior<S>* prior, TrackedFrame<S>& frame) {
  const Keyframe<S>& keyframe = map.keyframes[map.index(id)];
  match_keyframe_points(keyframe, frame);
  const SE3<S> before = frame.cam_from_world;
  PoseEstimate<S> estimate = solve(map, prior, frame);
  if (!estimate.ok()) return estimate;
  recent_.points.clear();
  recent_.lines.clear();
  for (const LandmarkId landmark : keyframe.line_landmarks)
    if (landmark != kNone) recent_.lines.push_back(landmark);
  match_lines_by_projection<S>(map, recent_.lines, frame, options.match.line_radius, options.match.lines,
                               [](LandmarkId, bool) {});
  estimate = solve(map, prior, frame);
  if (!estimate.ok()) frame.cam_from_world = before;
  return estimate;
}
static_assert(FallbackStage<FeatureFallback<double>, double>);

// Never answers: a frame without Manhattan evidence is lost.
template <Scalar S>
struct NoFallback {
  [[nodiscard]] PoseEstimate<S> track(const Map<S>&, const RecentLandmarks<S>&, const RotationPrior<S>*,
                                      TrackedFrame<S>&) {
    return {};
  }
  [[nodiscard]] PoseEstimate<S> track_keyframe(const Map<S>&, KeyframeId, const RotationPrior<S>*,
                                               TrackedFrame<S>&) {
    return {};
  }
};
static_assert(FallbackStage<NoFallback<double>, double>);

}  // namespace sslam
