// SPDX-License-Identifier: BSD-3-Clause
// Initialisation by decoupled rotation and translation (Li et al. 2020, section IV): rotations from the Manhattan
// frame, translation as the null vector of the point matches; it waits through pure rotation.
#pragma once

#include <algorithm>
#include <vector>

#include "sslam/solver/relative_pose.hpp"
#include "sslam/solver/translation.hpp"
#include "sslam/solver/triangulate_point.hpp"
#include "sslam/track/match_points.hpp"
#include "sslam/track/result.hpp"

namespace sslam {

template <Scalar S>
class DecoupledInitialisation {
 public:
  S search_radius = 30;                // pixels around where a feature was last seen, turned with the camera
  int min_matches = 25;                // with the reference frame: fewer make the newest frame the reference
  int min_points = 20;                 // landmarks that a first map must have
  S min_parallax = radians(S(1));      // of a landmark that counts
  S max_direction_sigma = radians(S(6));  // standard deviation of the direction of the translation
  S mean_depth = 1;                    // median depth of the first map: sets the monocular scale
  std::uint64_t seed = 1;
  PointMatchOptions<S> match{.max_distance = 60, .max_ratio = S(0.9)};

  // Tries to make a first map from the reference frame and this one. On success (kNone) the map holds both as
  // keyframes with their points, and the frame has its pose and matches.
  [[nodiscard]] Reason start(TrackedFrame<S>& frame, Map<S>& map) {
    if (frame.frame.points.size() < static_cast<std::size_t>(min_points)) return Reason::kTooFewFeatures;
    if (!has_reference_) return adopt(frame, Reason::kTooFewMatches);
    follow(frame);
    if (static_cast<int>(pairs_.size()) < min_matches) return adopt(frame, Reason::kTooFewMatches);
    SO3<S> R_10;
    Vec3<S> t_10;
    const Reason reason = relative_pose(frame, R_10, t_10);
    if (reason != Reason::kNone) return reason;
    return build(frame, R_10, t_10, map);
  }

  void reset() { has_reference_ = false; }

 private:
  Reason adopt(const TrackedFrame<S>& frame, Reason reason) {
    reference_ = frame;
    has_reference_ = true;
    last_pixels_.resize(frame.frame.points.size());
    for (std::size_t i = 0; i < last_pixels_.size(); ++i) last_pixels_[i] = frame.frame.points[i].pixel;
    last_rotation_ = frame.cam_from_world.rotation;
    return reason;
  }

  // Finds the reference's features in this frame, near where they were last seen.
  void follow(const TrackedFrame<S>& frame) {
    const SO3<S> turn = frame.cam_from_world.rotation * last_rotation_.inverse();
    const Pinhole<S>& pinhole = frame.frame.pinhole;
    match_points_mutually<S>(
        reference_.frame.points, frame.frame.points, match,
        [&](std::int32_t i, auto visit) {
          const Vec3<S> ray = turn * pinhole.unproject(last_pixels_[Map<S>::index(i)]);
          if (ray.z() <= 0) return;
          const Vec2<S> expected = pinhole.project(ray);
          const PointFeature<S>& from = reference_.frame.points[Map<S>::index(i)];
          frame.grid.near(expected, search_radius, [&](std::int32_t j) {
            const PointFeature<S>& to = frame.frame.points[Map<S>::index(j)];
            const S scale = to.sigma / from.sigma;
            if (scale < match.max_scale_ratio && scale * match.max_scale_ratio > 1 &&
                (to.pixel - expected).squaredNorm() < search_radius * search_radius)
              visit(j);
          });
        },
        pairs_);
    keep_consistent_rotation<S>(reference_.frame.points, frame.frame.points, pairs_);
    last_rotation_ = frame.cam_from_world.rotation;
    for (Vec2<S>& pixel : last_pixels_) {
      const Vec3<S> ray = turn * pinhole.unproject(pixel);
      if (ray.z() > 0) pixel = pinhole.project(ray);
    }
    for (const IndexPair& p : pairs_)
      last_pixels_[Map<S>::index(p.first)] = frame.frame.points[Map<S>::index(p.second)].pixel;
  }

  [[nodiscard]] Reason relative_pose(const TrackedFrame<S>& frame, SO3<S>& R_10, Vec3<S>& t_10);
  [[nodiscard]] Reason build(TrackedFrame<S>& frame, const SO3<S>& R_10, const Vec3<S>& t_10, Map<S>& map);

  TrackedFrame<S> reference_;
  bool has_reference_ = false;
  std::vector<Vec2<S>> last_pixels_;  // where each feature of the reference was last seen
  SO3<S> last_rotation_;
  std::vector<IndexPair> pairs_;
  std::vector<BearingMatch<S>> bearings_;
  std::vector<std::uint8_t> inliers_;
};

}  // namespace sslam
