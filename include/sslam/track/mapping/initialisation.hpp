// SPDX-License-Identifier: BSD-3-Clause
// Initialisation by decoupled rotation and translation (Li et al. 2020, section IV): rotations from the
// Manhattan frame, translation as the null vector of the point matches; it waits through pure rotation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "sslam/core/median.hpp"
#include "sslam/core/parameter.hpp"
#include "sslam/solver/triangulation/triangulate_point.hpp"
#include "sslam/solver/two_view/find_relative_pose.hpp"
#include "sslam/solver/two_view/relative_pose.hpp"
#include "sslam/solver/two_view/translation.hpp"
#include "sslam/track/contract/concepts.hpp"
#include "sslam/track/mapping/feature_follower.hpp"

namespace sslam {

template <Scalar S>
struct InitialisationOptions {
  S search_radius = 30;  // pixels around where a feature was last seen, turned with the camera
  int min_matches = 18;  // with the reference frame: fewer make the newest frame the reference
  int min_points = 20;   // landmarks that a first map must have
  S max_direction_sigma = radians(S(6));  // standard deviation of the direction of the translation
  S max_rotation_sigma = radians(S(2));   // of a Manhattan rotation that is taken as known
  S turn_share =
      S(0.6);  // error of the turn between two frames over that of their rotations: what they share cancels
  S scene_depth = 1;  // median depth of the first map: sets the monocular scale
  PointMatchOptions<S> match{.max_distance = 60, .max_ratio = S(0.9)};
  TranslationOptions<S> translation;  // with a Manhattan rotation
  FindRelativePoseOptions<S> pose;    // without one; its refinement serves both
  PointTriangulationOptions<S> triangulation;

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("min_points", self.min_points, Unit::kCount, 8, 1e6, "landmarks of the first map");
    visit("min_matches", self.min_matches, Unit::kCount, 5, 1e6, "matches with the reference frame");
    visit("min_parallax", self.triangulation.min_parallax, Unit::kDegrees, 0, 90,
          "of a landmark that counts");
    visit("max_direction_sigma", self.max_direction_sigma, Unit::kDegrees, 0, 180,
          "standard deviation of the direction of the translation");
    visit("max_rotation_sigma", self.max_rotation_sigma, Unit::kDegrees, 0, 180,
          "standard deviation of a Manhattan rotation that is taken as known");
    visit("turn_share", self.turn_share, Unit::kNumber, 0.01, 10,
          "error of the turn between two frames over that of their Manhattan rotations");
    visit("search_radius", self.search_radius, Unit::kPixels, 1, kUnbounded,
          "around where a feature was last seen");
    visit("scene_depth", self.scene_depth, Unit::kNumber, 1e-6, 1e6,
          "median depth of the first map: sets the scale");
    visit_within("match.", self.match, visit);
    visit_within("translation.", self.translation, visit);
    visit_within("pose.", self.pose, visit);
    visit_within("triangulation.", self.triangulation, visit);
  }
};
static_assert(Described<InitialisationOptions<double>>);

template <Scalar S>
class DecoupledInitialisation {
 public:
  InitialisationOptions<S> options;
  std::uint64_t seed = 1;

  // Tries to make a first map from the reference frame and this one. On success (kFine) the map holds both as
  // keyframes with their points, and the frame has its pose and matches.
  [[nodiscard]] Reason start(TrackedFrame<S>& frame, Map<S>& map);

  void reset() { has_reference_ = false; }

 private:
  Reason adopt(const TrackedFrame<S>& frame, Reason reason) {
    reference_ = frame;
    has_reference_ = true;
    follower_.begin(frame);
    return reason;
  }

  [[nodiscard]] Reason relative_pose(const TrackedFrame<S>& frame, SO3<S>& R_10, Vec3<S>& t_10) {
    bearings_.clear();
    const Pinhole<S>& k = frame.frame.pinhole;
    for (const IndexPair& p : pairs_) {
      const PointFeature<S>& a = reference_.frame.points[Map<S>::index(p.first)];
      const PointFeature<S>& b = frame.frame.points[Map<S>::index(p.second)];
      bearings_.push_back({k.unproject(a.pixel), k.unproject(b.pixel), std::max(a.sigma, b.sigma) / k.fx});
    }
    inliers_.assign(bearings_.size(), 0);
    prepare_prior(frame);
    RelativePoseSummary<S> summary = decoupled(R_10, t_10);
    if (!usable(summary.status)) {
      // No Manhattan frame, or one that the matches do not agree with.
      const auto alone = find_relative_pose<S>(bearings_, options.pose, seed, R_10, t_10, inliers_);
      if (usable(alone.status) || summary.status == Status::kTooFew) summary = alone;
    }
    if (summary.status == Status::kLowParallax) return Reason::kLowParallax;
    if (!usable(summary.status)) return Reason::kNoConsensus;
    const S sigma = std::sqrt(summary.translation_covariance.trace());
    return sigma < options.max_direction_sigma ? Reason::kFine : Reason::kLowParallax;
  }

  // The relative rotation that the two Manhattan rotations give, and its covariance, where both are there.
  void prepare_prior(const TrackedFrame<S>& frame) {
    prior_.reset();
    if (!reference_.manhattan || !frame.manhattan) return;
    const SO3<S> R_10 = frame.manhattan->cam_from_world * reference_.manhattan->cam_from_world.inverse();
    const Mat3<S> turn = R_10.matrix();
    const S share = options.turn_share * options.turn_share;
    prior_ = {R_10, share * (frame.manhattan->covariance +
                             turn * reference_.manhattan->covariance * turn.transpose())};
  }

  // Translation as a null vector with the Manhattan rotation, then a refinement of both in which the rotation
  // is held by its covariance. kTooFew without a Manhattan rotation that can be trusted about every axis.
  [[nodiscard]] RelativePoseSummary<S> decoupled(SO3<S>& R_10, Vec3<S>& t_10) {
    if (!prior_) return {};
    TranslationOptions<S> known = options.translation;
    known.rotation_sigma = std::sqrt(prior_->covariance.trace() / 3);
    if (!(known.rotation_sigma < options.max_rotation_sigma)) return {};
    const auto estimate = translation_from_rotation<S>(bearings_, prior_->cam_from_world, known, seed);
    if (!usable(estimate.status)) return {.status = estimate.status};
    R_10 = prior_->cam_from_world;
    t_10 = estimate.t_10;
    RelativePoseOptions<S> held = options.pose.refinement;
    held.start_sigma = known.rotation_sigma;
    held.prior_R_10 = prior_->cam_from_world;
    held.prior_information = prior_->covariance.inverse();
    return refine_relative_pose<S>(bearings_, R_10, t_10, held, inliers_);
  }

  // Triangulates the inliers; the two frames become the first keyframes.
  [[nodiscard]] Reason build(TrackedFrame<S>& frame, const SO3<S>& R_10, const Vec3<S>& t_10, Map<S>& map) {
    const SE3<S> frame_from_reference{R_10, t_10};
    seeds_.clear();
    depths_.clear();
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      if (!inliers_[i]) continue;
      const BearingMatch<S>& bearing = bearings_[i];
      const std::array views{
          PointView<S>{SE3<S>(), bearing.ray0.template head<2>(), bearing.sigma},
          PointView<S>{frame_from_reference, bearing.ray1.template head<2>(), bearing.sigma}};
      const auto answer = triangulate_point<S>(views, options.triangulation);
      if (!usable(answer.status)) continue;
      seeds_.push_back({pairs_[i], answer.point});
      depths_.push_back(answer.point.z());
    }
    if (static_cast<int>(seeds_.size()) < options.min_points) return Reason::kLowParallax;
    const S scale = options.scene_depth / median<S>(depths_);
    reference_.cam_from_world = {reference_rotation(frame, R_10), Vec3<S>::Zero()};
    frame.cam_from_world = {R_10 * reference_.cam_from_world.rotation, scale * t_10};
    reference_.forget_matches();
    frame.forget_matches();
    map.add_keyframe(reference_.to_keyframe());
    map.add_keyframe(frame.to_keyframe());
    const SE3<S> world_from_reference = reference_.cam_from_world.inverse();
    for (const Seed& s : seeds_) {
      const LandmarkId id = map.add_point(world_from_reference * Vec3<S>(scale * s.point), 1);
      map.observe_point(id, 0, Map<S>::index(s.pair.first));
      map.observe_point(id, 1, Map<S>::index(s.pair.second));
    }
    map.update_covisibility(0);
    map.update_covisibility(1);
    has_reference_ = false;
    return Reason::kFine;
  }

  // The reference sits at the world's origin. Its rotation is that of the Manhattan frame, by whichever of
  // the two frames knows it better.
  [[nodiscard]] SO3<S> reference_rotation(const TrackedFrame<S>& frame, const SO3<S>& R_10) const {
    const bool by_reference =
        reference_.manhattan &&
        (!frame.manhattan || reference_.manhattan->covariance.trace() <= frame.manhattan->covariance.trace());
    if (by_reference) return reference_.manhattan->cam_from_world;
    if (frame.manhattan) return R_10.inverse() * frame.manhattan->cam_from_world;
    return reference_.cam_from_world.rotation;
  }

  struct Seed {
    IndexPair pair;
    Vec3<S> point;  // in the reference camera, at unit baseline
  };

  TrackedFrame<S> reference_;
  bool has_reference_ = false;
  FeatureFollower<S> follower_;
  std::optional<RotationObservation<S>> prior_;  // frame from reference
  std::vector<IndexPair> pairs_;
  std::vector<BearingMatch<S>> bearings_;
  std::vector<std::uint8_t> inliers_;
  std::vector<Seed> seeds_;
  std::vector<S> depths_;
};

template <Scalar S>
Reason DecoupledInitialisation<S>::start(TrackedFrame<S>& frame, Map<S>& map) {
  if (frame.frame.points.size() < static_cast<std::size_t>(options.min_points))
    return Reason::kTooFewFeatures;
  if (!has_reference_) return adopt(frame, Reason::kTooFewMatches);
  const auto enough = static_cast<std::size_t>(options.min_matches);
  pairs_ = follower_.follow(reference_, frame, options.search_radius, enough, options.match, seed);
  if (pairs_.size() < enough) return adopt(frame, Reason::kTooFewMatches);
  SO3<S> R_10;
  Vec3<S> t_10;
  const Reason reason = relative_pose(frame, R_10, t_10);
  if (reason != Reason::kFine) return reason;
  return build(frame, R_10, t_10, map);
}
static_assert(InitialisationStage<DecoupledInitialisation<double>, double>);

}  // namespace sslam
