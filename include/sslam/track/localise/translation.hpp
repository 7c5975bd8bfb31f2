// SPDX-License-Identifier: BSD-3-Clause
// Decoupled tracking: with the Manhattan rotation fixed, three degrees of freedom remain, and points and
// lines of the last two frames fix them (Li et al. 2020, section V-B).
#pragma once

#include "sslam/core/parameter.hpp"
#include "sslam/track/contract/concepts.hpp"
#include "sslam/track/matching/match_lines.hpp"
#include "sslam/track/matching/pose_acceptance.hpp"

namespace sslam {

template <Scalar S>
struct MatchOptions {
  S point_radius = 20;  // pixels around the prediction, at the finest octave
  S line_radius = 25;   // pixels between a predicted line and the ends of a segment
  PointMatchOptions<S> points;
  LineMatchOptions<S> lines;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("point_radius", self.point_radius, Unit::kPixels, 0.1, kUnbounded,
          "search window around a predicted point");
    visit("line_radius", self.line_radius, Unit::kPixels, 0.1, kUnbounded,
          "search band around a predicted line");
    visit_within("points.", self.points, visit);
    visit_within("lines.", self.lines, visit);
  }
};
static_assert(Described<MatchOptions<double>>);

// Drops the frame's matches and finds new ones among the recent landmarks, from the pose that the frame has
// now.
template <Scalar S>
void match_recent(const Map<S>& map, const RecentLandmarks<S>& recent, S widening,
                  const MatchOptions<S>& options, TrackedFrame<S>& frame) {
  frame.forget_matches();
  const auto ignore = [](LandmarkId, bool) {};
  match_points_by_projection<S>(map, recent.points, frame, options.point_radius * widening, options.points,
                                ignore);
  match_lines_by_projection<S>(map, recent.lines, frame, options.line_radius * widening, options.lines,
                               ignore);
}

template <Scalar S>
struct DecoupledTranslationOptions {
  MatchOptions<S> match;
  PoseAcceptance<S> acceptance{.min_inliers = 5, .min_inlier_share = S(0.6)};
  PoseRefinementOptions<S> solver;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("", self.match, visit);
    visit_within("", self.acceptance, visit);
    visit_within("solver.", self.solver, visit);
  }
};
static_assert(Described<DecoupledTranslationOptions<double>>);

template <Scalar S>
class DecoupledTranslation {
 public:
  DecoupledTranslationOptions<S> options;

  // In: the frame's pose has its Manhattan rotation and a predicted translation. Out: the solved translation
  // and the inlying matches, or, on failure, an unchanged pose.
  [[nodiscard]] PoseEstimate<S> translate(const Map<S>& map, const RecentLandmarks<S>& recent,
                                          TrackedFrame<S>& frame);

 private:
  Correspondences<S> matches_;
};

template <Scalar S>
PoseEstimate<S> DecoupledTranslation<S>::translate(const Map<S>& map, const RecentLandmarks<S>& recent,
                                                   TrackedFrame<S>& frame) {
  match_recent(map, recent, S(1), options.match, frame);
  matches_.gather(map, frame);
  if (static_cast<int>(matches_.size()) < options.acceptance.min_inliers) return {};
  SE3<S> pose = frame.cam_from_world;
  const auto summary = refine_translation<S>(frame.frame.pinhole, matches_.points, matches_.lines, pose,
                                             options.solver, matches_.point_inliers, matches_.line_inliers);
  return settle_pose(summary, pose, options.acceptance, matches_, frame);
}
static_assert(TranslationStage<DecoupledTranslation<double>, double>);

// Never answers: every frame takes the fallback, with its full six degrees of freedom.
template <Scalar S>
struct NoTranslation {
  [[nodiscard]] PoseEstimate<S> translate(const Map<S>&, const RecentLandmarks<S>&, TrackedFrame<S>&) {
    return {.reason = Reason::kNoManhattanFrame};
  }
};
static_assert(TranslationStage<NoTranslation<double>, double>);

}  // namespace sslam
