// SPDX-License-Identifier: BSD-3-Clause
// What a solved pose must show before it is believed.
#pragma once

#include "sslam/core/parameter.hpp"
#include "sslam/geometry/spread.hpp"
#include "sslam/solver/least_squares/positive_inverse.hpp"
#include "sslam/solver/pose/pose_refinement.hpp"
#include "sslam/track/contract/pose_estimate.hpp"
#include "sslam/track/contract/tracked_frame.hpp"
#include "sslam/track/matching/correspondences.hpp"

namespace sslam {

template <Scalar S>
struct PoseAcceptance {
  int min_inliers = 10;            // points plus lines
  S min_inlier_share = S(0.4);     // of all matches
  S max_position_sigma = S(0.03);  // standard deviation of the camera's place over the median scene depth
  S max_rotation_sigma = radians(S(1.5));  // standard deviation of the camera's rotation, about any axis

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("min_inliers", self.min_inliers, Unit::kCount, 3, 1e6, "points plus lines");
    visit("min_inlier_share", self.min_inlier_share, Unit::kShare, 0, 1, "of all matches");
    visit("max_position_sigma", self.max_position_sigma, Unit::kNumber, 0, kUnbounded,
          "of the camera's place, over the median scene depth");
    visit("max_rotation_sigma", self.max_rotation_sigma, Unit::kDegrees, 0, 180,
          "of the camera's rotation, where that is solved for");
  }
};
static_assert(Described<PoseAcceptance<double>>);

// Judges a solved pose by its inliers and, through the information matrix of the tangent xi = (phi, rho) or
// of rho alone, by how well they pin it down.
template <Scalar S, int D>
[[nodiscard]] PoseEstimate<S> judge(Correspondences<S>& matches, const SE3<S>& cam_from_world,
                                    const Mat<S, D, D>& information, const PoseAcceptance<S>& acceptance) {
  PoseEstimate<S> estimate;
  estimate.point_inliers = matches.point_inlier_count();
  estimate.line_inliers = matches.line_inlier_count();
  const int inliers = estimate.point_inliers + estimate.line_inliers;
  if (inliers < acceptance.min_inliers) return estimate;
  estimate.reason = Reason::kNoConsensus;
  if (static_cast<S>(inliers) < acceptance.min_inlier_share * static_cast<S>(matches.size())) return estimate;
  estimate.reason = Reason::kUncertainPose;
  estimate.scene_depth = matches.median_depth(cam_from_world);
  Mat<S, D, D> covariance;
  if (!inverse_of<S, D>(information, covariance)) return estimate;
  const auto spread = [&](int at) { return largest_sigma<S>(covariance.template block<3, 3>(at, at)); };
  if (!(spread(D - 3) < acceptance.max_position_sigma * estimate.scene_depth)) return estimate;
  if (D == 6 && !(spread(0) < acceptance.max_rotation_sigma)) return estimate;
  if constexpr (D == 6) estimate.covariance = covariance;
  estimate.reason = Reason::kFine;
  return estimate;
}

// A solved pose that is believed becomes the frame's, and the matches of its outliers go; otherwise the frame
// stays as it is.
template <Scalar S, int D>
[[nodiscard]] PoseEstimate<S> settle_pose(const PoseSummary<S, D>& solved, const SE3<S>& cam_from_world,
                                          const PoseAcceptance<S>& acceptance, Correspondences<S>& matches,
                                          TrackedFrame<S>& frame) {
  if (!usable(solved.status)) return {.reason = Reason::kNoConsensus};
  const PoseEstimate<S> estimate = judge<S, D>(matches, cam_from_world, solved.information, acceptance);
  if (!estimate.ok()) return estimate;
  matches.drop_outliers(frame);
  frame.cam_from_world = cam_from_world;
  return estimate;
}

}  // namespace sslam
