// SPDX-License-Identifier: BSD-3-Clause
// What makes the figures of a comparison doubtful though they could be worked out.
#pragma once

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sslam/io/evaluation/alignment.hpp"
#include "sslam/io/evaluation/paired_poses.hpp"
#include "sslam/io/evaluation/reflection.hpp"
#include "sslam/io/evaluation/statistics.hpp"

namespace sslam::io {

namespace doubts_detail {

// Whether the second widest extent is nothing beside the widest.
[[nodiscard]] inline bool on_a_line(const std::vector<Vec3<double>>& points) {
  constexpr double kThin = 1e-3;
  Vec3<double> mean = Vec3<double>::Zero();
  for (const Vec3<double>& point : points) mean += point / static_cast<double>(points.size());
  Mat3<double> scatter = Mat3<double>::Zero();
  for (const Vec3<double>& point : points) scatter += (point - mean) * (point - mean).transpose();
  const Vec3<double> extents = Eigen::SelfAdjointEigenSolver<Mat3<double>>(scatter).eigenvalues();
  return extents[1] <= kThin * kThin * extents[2];
}

// The rotation of a quaternion that was read with w last and has it first.
[[nodiscard]] inline SO3<double> with_w_first(const SO3<double>& rotation) {
  const auto q = rotation.quaternion();
  return SO3<double>::from_quaternion(q.x(), q.y(), q.z(), q.w());
}

// Of the rotations, after the constant turn that suits them best.
[[nodiscard]] inline double rotation_rmse(const PairedPoses& paired) {
  return statistics_of(rotation_errors(paired, rotation_offset(paired))).rmse;
}

template <class Change>
[[nodiscard]] Trajectory changed(Trajectory poses, Change change) {
  for (StampedPose& pose : poses) change(pose.world_from_cam);
  return poses;
}

inline void reorder(SE3<double>& pose) {
  pose.rotation = with_w_first(pose.rotation);
}

inline constexpr const char* kWFirst = "have w first: the rotations would agree; expected qx qy qz qw";

// Where the camera hardly turns, some constant turn suits any order of the quaternions. The turn that suits
// the positions does not.
[[nodiscard]] inline std::string better_order(const PairedPoses& paired) {
  constexpr double kBad = 0.5, kBetter = 0.25;  // radians; share of it that is left
  const std::vector<Vec3<double>> truth = positions_of(paired.truth),
                                  estimate = positions_of(paired.estimate);
  if (on_a_line(truth) || on_a_line(estimate)) return {};
  const SO3<double> turn = align(estimate, truth, Alignment::kSe3).rotation;
  const auto error = [&turn](const PairedPoses& poses) {
    return statistics_of(rotation_errors(poses, turn)).rmse;
  };
  const double as_read = error(paired);
  if (as_read < kBad) return {};
  const double of_estimate = error({paired.truth, changed(paired.estimate, reorder)}),
               of_truth = error({changed(paired.truth, reorder), paired.estimate});
  if (std::min(of_estimate, of_truth) >= kBetter * as_read) return {};
  return std::string(of_estimate < of_truth ? "the estimate's" : "the ground truth's") +
         " quaternions seem to " + kWFirst;
}

// How another reading of either file's rotations would make them agree; empty: none does.
[[nodiscard]] inline std::string better_reading(const PairedPoses& paired) {
  constexpr double kBad = 0.1, kBetter = 0.25;  // radians; share of it that is left
  const auto invert = [](SE3<double>& pose) { pose = pose.inverse(); };
  const double as_read = rotation_rmse(paired);
  if (as_read < kBad) return better_order(paired);
  double least = kBetter * as_read;
  std::string best;
  const auto consider = [&](const PairedPoses& other, std::string meaning) {
    const double rmse = rotation_rmse(other);
    if (rmse >= least) return;
    least = rmse;
    best = std::move(meaning);
  };
  const std::string order = kWFirst;
  consider({paired.truth, changed(paired.estimate, reorder)}, "the estimate's quaternions seem to " + order);
  consider({changed(paired.truth, reorder), paired.estimate},
           "the ground truth's quaternions seem to " + order);
  consider({paired.truth, changed(paired.estimate, invert)},
           "the estimate's rotations seem to be inverted (world to camera, or quaternions of JPL's kind): "
           "inverted, they would agree; expected camera to world, and Hamilton's quaternions");
  for (int axis = 0; axis < 3; ++axis)
    consider(
        {paired.truth, changed(paired.estimate, [axis](SE3<double>& pose) { pose = mirrored(pose, axis); })},
        std::string("the estimate seems to be a mirror image of the ground truth: with its ") + "xyz"[axis] +
            " negated the rotations would agree (ground truth with y up: --axes)");
  return best;
}

// The unit that a scale betrays; empty: none.
[[nodiscard]] inline std::string other_unit(double scale) {
  constexpr double kTolerance = 0.05;
  constexpr std::array<std::pair<double, std::string_view>, 4> kUnits{
      {{1e-3, "the estimate seems to be in millimetres"},
       {1e-2, "the estimate seems to be in centimetres"},
       {1e2, "the ground truth seems to be in centimetres"},
       {1e3, "the ground truth seems to be in millimetres"}}};
  for (const auto& [wanted, text] : kUnits)
    if (std::abs(scale / wanted - 1) < kTolerance) return std::string(text) + ", the other in metres";
  return {};
}

}  // namespace doubts_detail

// `poses`: of the estimate. `rmse`: of the positions after the alignment.
[[nodiscard]] inline std::vector<std::string> doubts_about(const PairedPoses& paired, Alignment alignment,
                                                           std::size_t poses, double rmse) {
  using namespace doubts_detail;
  constexpr std::size_t kFew = 10;
  constexpr double kNoLikeness = 0.9;
  std::vector<std::string> notes;
  const std::size_t pairs = paired.truth.size();
  const std::vector<Vec3<double>> truth = positions_of(paired.truth),
                                  estimate = positions_of(paired.estimate);
  if (pairs < kFew || 2 * pairs < poses)
    notes.push_back("only " + std::to_string(pairs) + " of " + std::to_string(poses) +
                    " poses have a partner in the ground truth");
  if (alignment == Alignment::kNone || pairs < 3) return notes;
  if (on_a_line(truth) || on_a_line(estimate))
    notes.emplace_back(
        "the positions lie on a line: the turn about it is open, and with it the row 'rotation'");
  if (std::string mirror = reflection_note(paired, alignment, rmse); !mirror.empty())
    notes.push_back(std::move(mirror));
  else if (const std::string reading = better_reading(paired); !reading.empty())
    notes.push_back(reading);
  const double spread = spread_of(truth);
  if (alignment == Alignment::kSim3 && rmse > kNoLikeness * spread)
    notes.emplace_back(
        "the estimate's path has no likeness with the ground truth's: the error is as large as the path");
  if (alignment == Alignment::kSe3 && !stands_still(estimate, spread) &&
      !stands_still(truth, spread_of(estimate)))
    if (const std::string unit = other_unit(align(estimate, truth, Alignment::kSim3).scale); !unit.empty())
      notes.push_back(unit);
  return notes;
}

}  // namespace sslam::io
