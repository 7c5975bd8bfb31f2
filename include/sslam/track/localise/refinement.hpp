// SPDX-License-Identifier: BSD-3-Clause
// Refinement of a tracked pose against the local map of the last keyframes, with all six degrees of freedom;
// the Manhattan rotation takes part as one more observation, weighed by its own covariance.
#pragma once

#include "sslam/core/parameter.hpp"
#include "sslam/geometry/spread.hpp"
#include "sslam/map/local_map.hpp"
#include "sslam/track/localise/translation.hpp"

namespace sslam {

template <Scalar S>
struct RefinementOptions {
  MatchOptions<S> match{.point_radius = 6, .line_radius = 10, .points = {}, .lines = {}};
  PoseAcceptance<S> acceptance{.min_inlier_share = S(0.3)};
  // With the rotation given by the Manhattan frame to this standard deviation, three degrees of freedom are
  // left, and fewer inliers than the acceptance's are enough.
  int min_inliers_turned = 5;
  S turned_sigma = radians(S(0.7));
  PoseRefinementOptions<S> solver;
  std::size_t max_keyframes = 20;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit_within("", self.match, visit);
    visit_within("", self.acceptance, visit);
    visit_within("solver.", self.solver, visit);
    visit("min_inliers_turned", self.min_inliers_turned, Unit::kCount, 3, 1e+06,
          "min_inliers where the Manhattan frame gives the rotation");
    visit("turned_sigma", self.turned_sigma, Unit::kDegrees, 0, 45,
          "largest standard deviation of a Manhattan rotation that gives the frame's");
    visit("max_keyframes", self.max_keyframes, Unit::kCount, 1, 1e+06, "of the local map");
  }
};
static_assert(Described<RefinementOptions<double>>);

template <Scalar S>
class LocalMapRefinement {
 public:
  RefinementOptions<S> options;

  // In: a tracked pose with its matches. Out: the refined pose with the local map's inlying matches; the
  // landmarks' visible and found counts are brought up to date. Unchanged pose on failure.
  [[nodiscard]] PoseEstimate<S> refine(Map<S>& map, const RotationPrior<S>* prior, TrackedFrame<S>& frame);

  // The same for a place that is only supposed: the map stays as it is.
  [[nodiscard]] PoseEstimate<S> refine_uncounted(const Map<S>& map, const RotationPrior<S>* prior,
                                                 TrackedFrame<S>& frame);

  // What a pose must show, with a rotation from the Manhattan frame or without one.
  [[nodiscard]] PoseAcceptance<S> accepts(const RotationPrior<S>* prior) const noexcept {
    PoseAcceptance<S> wanted = options.acceptance;
    if (prior != nullptr && gives_rotation(*prior)) wanted.min_inliers = options.min_inliers_turned;
    return wanted;
  }

 private:
  [[nodiscard]] bool gives_rotation(const RotationPrior<S>& prior) const noexcept {
    return symmetric_eigenvalues<S>(prior.information).x() * options.turned_sigma * options.turned_sigma >=
           S(1);
  }

  // `visible` becomes those that are matched.
  static void drop_matched(std::vector<LandmarkId>& candidates, const std::vector<LandmarkId>& matched,
                           std::vector<LandmarkId>& visible) {
    visible.clear();
    for (const LandmarkId id : matched)
      if (id != kNone) visible.push_back(id);
    std::sort(visible.begin(), visible.end());
    std::erase_if(candidates,
                  [&](LandmarkId id) { return std::binary_search(visible.begin(), visible.end(), id); });
  }

  static void count_found(Map<S>& map, const TrackedFrame<S>& frame) {
    for (const LandmarkId id : frame.point_landmarks)
      if (id != kNone) ++map.points[map.index(id)].found;
    for (const LandmarkId id : frame.line_landmarks)
      if (id != kNone) ++map.lines[map.index(id)].found;
  }

  LocalMap<S> local_;
  Correspondences<S> matches_;
  std::vector<LandmarkId> visible_points_, visible_lines_;  // that the frame should show
};

template <Scalar S>
PoseEstimate<S> LocalMapRefinement<S>::refine(Map<S>& map, const RotationPrior<S>* prior,
                                              TrackedFrame<S>& frame) {
  const PoseEstimate<S> estimate = refine_uncounted(map, prior, frame);
  for (const LandmarkId id : visible_points_) ++map.points[map.index(id)].visible;
  for (const LandmarkId id : visible_lines_) ++map.lines[map.index(id)].visible;
  if (estimate.ok()) count_found(map, frame);
  return estimate;
}

template <Scalar S>
PoseEstimate<S> LocalMapRefinement<S>::refine_uncounted(const Map<S>& map, const RotationPrior<S>* prior,
                                                        TrackedFrame<S>& frame) {
  local_.gather(map, frame.point_landmarks, frame.line_landmarks, options.max_keyframes);
  drop_matched(local_.points, frame.point_landmarks, visible_points_);
  drop_matched(local_.lines, frame.line_landmarks, visible_lines_);
  match_points_by_projection<S>(map, local_.points, frame, options.match.point_radius, options.match.points,
                                [&](LandmarkId id, bool) { visible_points_.push_back(id); });
  match_lines_by_projection<S>(map, local_.lines, frame, options.match.line_radius, options.match.lines,
                               [&](LandmarkId id, bool) { visible_lines_.push_back(id); });
  matches_.gather(map, frame);
  SE3<S> pose = frame.cam_from_world;
  const auto summary = refine_pose<S>(frame.frame.pinhole, matches_.points, matches_.lines, pose,
                                      options.solver, matches_.point_inliers, matches_.line_inliers, prior);
  return settle_pose(summary, pose, accepts(prior), matches_, frame);
}
static_assert(RefinementStage<LocalMapRefinement<double>, double>);

// Takes the tracked pose as it is.
template <Scalar S>
struct NoRefinement {
  [[nodiscard]] PoseEstimate<S> refine(Map<S>&, const RotationPrior<S>*, TrackedFrame<S>& frame) {
    PoseEstimate<S> taken;
    taken.reason = Reason::kFine;
    taken.point_inliers = count_held(frame.point_landmarks);
    taken.line_inliers = count_held(frame.line_landmarks);
    return taken;
  }
};
static_assert(RefinementStage<NoRefinement<double>, double>);

}  // namespace sslam
