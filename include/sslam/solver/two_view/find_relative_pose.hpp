// SPDX-License-Identifier: BSD-3-Clause
// Relative pose from matches alone, for views that are not far apart: search, refinement, and checks against
// a pure rotation and against the second answer of a flat scene.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "sslam/solver/two_view/plane_rival.hpp"
#include "sslam/solver/two_view/relative_pose_search.hpp"

namespace sslam {

namespace detail {

// Refines the rival of a refined pose where the scene is flat, and keeps the better one of the two.
// kDegenerate when the difference is too small to tell.
template <Scalar S>
void challenge(std::span<const BearingMatch<S>> matches, const FindRelativePoseOptions<S>& options,
               RelativePose<S>& pose, RelativePoseSummary<S>& summary) noexcept {
  const RelativePoseOptions<S>& o = options.refinement;
  Vec3<S> normal;
  constexpr S kFlat = S(0.6);  // with fewer points in one plane, the others decide
  if (scene_plane(matches, pose, FlowGate<S>{.max_error = o.max_error}, normal) < kFlat) return;
  RelativePose<S> rival;
  if (!plane_rival(pose, normal, rival)) return;
  RelativePoseOptions<S> wide = o;
  wide.start_sigma = std::max(o.start_sigma, S(0.02));  // rad: the scene need not be flat all over
  const RelativePoseSummary<S> other = refine_relative_pose(matches, rival.R_10, rival.t_10, wide);
  if (other.status == Status::kDegenerate) summary.status = Status::kDegenerate;
  constexpr S kSame = S(0.98);  // cosine
  if (!usable(other.status) || rival.t_10.dot(pose.t_10) > kSame) return;
  const S gain = truncated_cost(matches, pose, o) - truncated_cost(matches, rival, o);
  if (gain > 0) {
    pose = rival;
    summary = other;
  }
  if (usable(summary.status) && std::abs(gain) < options.min_cost_gap) summary.status = Status::kDegenerate;
}

}  // namespace detail

// R_10 and the unit t_10 from matches alone, for rotations up to some 10 degrees. kLowParallax when a
// rotation alone explains the matches; kDegenerate, too, when a flat scene leaves two answers and no prior
// tells them apart. Outputs are written on success alone; the same seed gives the same answer.
template <Scalar S>
[[nodiscard]] RelativePoseSummary<S> find_relative_pose(std::span<const BearingMatch<S>> matches,
                                                        const FindRelativePoseOptions<S>& options,
                                                        std::uint64_t seed, SO3<S>& R_10, Vec3<S>& t_10,
                                                        std::span<std::uint8_t> inliers = {}) noexcept {
  RelativePoseSummary<S> summary;
  const auto refuse = [&](Status status) {
    summary.status = status;
    return summary;
  };
  const RotationFromBearings<S> turn = rotation_from_bearings(matches, options.rotation, seed);
  if (turn.status == Status::kNotFinite) return refuse(Status::kNotFinite);
  if (static_cast<int>(matches.size()) < std::max(options.refinement.min_inliers, 5)) return summary;

  Random random(seed);
  const RelativePoseSearch<S> search(matches, options, random);
  RelativePose<S> pose;
  if (!search.run(usable(turn.status) ? turn.R_10 : SO3<S>(), random, pose))
    return refuse(Status::kDegenerate);
  summary = refine_relative_pose(matches, pose.R_10, pose.t_10, options.refinement);
  if (!usable(summary.status) && summary.status != Status::kDegenerate) return summary;
  const auto still = static_cast<S>(turn.inliers);
  if (still > (1 - options.refinement.min_moved_share) * static_cast<S>(summary.inliers))
    return refuse(Status::kLowParallax);
  detail::challenge(matches, options, pose, summary);
  if (!usable(summary.status)) return summary;
  // Once more, now at its minimum, for the flags.
  summary = refine_relative_pose(matches, pose.R_10, pose.t_10, options.refinement, inliers);
  if (!usable(summary.status)) return summary;
  R_10 = pose.R_10;
  t_10 = pose.t_10;
  return summary;
}

}  // namespace sslam
