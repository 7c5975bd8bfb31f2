// SPDX-License-Identifier: BSD-3-Clause
// How good a trajectory is: absolute and relative pose error as the tools of the TUM RGB-D benchmark define
// them (Sturm et al., IROS 2012), rotation error, scale, share of frames tracked.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sslam/io/evaluation/alignment.hpp"
#include "sslam/io/evaluation/association.hpp"
#include "sslam/io/evaluation/doubts.hpp"
#include "sslam/io/evaluation/paired_poses.hpp"
#include "sslam/io/evaluation/relative_error.hpp"
#include "sslam/io/evaluation/statistics.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::io {

struct EvaluationOptions {
  Alignment alignment = Alignment::kSim3;
  double max_difference = kMaxStampDifference;  // between the stamps of a pair, in their unit
  double seconds_per_stamp = 1;                 // for deltas in seconds
  std::vector<double> frame_stamps{};  // of the images that could have been tracked; empty: not known
  std::size_t frames = 0;              // their number, where only that is known; 0: not known
  std::vector<Delta> deltas{{1, DeltaUnit::kFrames}, {1, DeltaUnit::kSeconds}};
};

struct Evaluation {
  EvaluationOptions options;
  std::size_t poses = 0;    // in the estimate
  std::size_t pairs = 0;    // of them, those with a ground truth pose
  std::size_t frames = 0;   // that could have been tracked; 0: not known
  std::size_t tracked = 0;  // of them, those with a pose
  Sim3<double> truth_from_estimate;
  Statistics position;             // ATE: distance after alignment, metres
  Statistics rotation;             // angle after the same alignment, radians
  Statistics rotation_own_offset;  // angle after the constant turn that suits the rotations best, radians
  std::vector<RelativeError> relative;
  double truth_path = 0;           // metres along the paired ground truth poses
  double estimate_path = 0;        // the same along the estimate, after scaling
  std::vector<std::string> notes;  // what makes the figures doubtful, a line each
};

[[nodiscard]] inline double path_length(const Trajectory& poses) {
  double length = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    length += (poses[i].world_from_cam.translation - poses[i - 1].world_from_cam.translation).norm();
  }
  return length;
}

// Distances after alignment.
[[nodiscard]] inline std::vector<double> position_errors(const PairedPoses& paired,
                                                         const Sim3<double>& truth_from_estimate) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < paired.truth.size(); ++i) {
    errors.push_back((truth_from_estimate * paired.estimate[i].world_from_cam.translation -
                      paired.truth[i].world_from_cam.translation)
                         .norm());
  }
  return errors;
}

// Says from when to when the stamps of both go: where few agree, these tell why.
[[nodiscard]] inline std::string stamp_ranges(const Trajectory& truth, const Trajectory& estimate) {
  const auto range = [](const Trajectory& poses) {
    return exact_decimal(poses.front().stamp, 0) + " to " + exact_decimal(poses.back().stamp, 0);
  };
  return "the stamps of the ground truth go from " + range(truth) + ", those of the estimate from " +
         range(estimate);
}

// Throws Error when the two do not overlap or cannot be aligned.
[[nodiscard]] inline Evaluation evaluate(const Trajectory& truth, const Trajectory& estimate,
                                         const EvaluationOptions& options = {}) {
  const PairedPoses paired = pair_poses(truth, estimate, options.max_difference);
  const std::vector<Vec3<double>> true_positions = positions_of(paired.truth);
  const std::vector<Vec3<double>> positions = positions_of(paired.estimate);
  constexpr std::size_t kFewest = 3;
  if (options.alignment != Alignment::kNone && positions.size() < kFewest)
    throw Error("alignment needs at least 3 pairs of poses, found " + std::to_string(positions.size()) +
                " within " + exact_decimal(options.max_difference, 0) + ": " + stamp_ranges(truth, estimate));
  Evaluation result;
  result.options = options;
  result.poses = estimate.size();
  result.pairs = paired.estimate.size();
  result.frames = options.frame_stamps.empty() ? options.frames : options.frame_stamps.size();
  result.tracked = options.frame_stamps.empty()
                       ? estimate.size()
                       : associate(options.frame_stamps, stamps_of(estimate), options.max_difference).size();
  result.truth_from_estimate = align(positions, true_positions, options.alignment);
  result.position = statistics_of(position_errors(paired, result.truth_from_estimate));
  result.rotation = statistics_of(rotation_errors(paired, result.truth_from_estimate.rotation));
  result.rotation_own_offset = statistics_of(rotation_errors(paired, rotation_offset(paired)));
  for (const Delta& delta : options.deltas) {
    result.relative.push_back(
        relative_error(paired, delta, result.truth_from_estimate.scale, options.seconds_per_stamp));
  }
  result.truth_path = path_length(paired.truth);
  result.estimate_path = result.truth_from_estimate.scale * path_length(paired.estimate);
  result.notes = doubts_about(paired, options.alignment, result.poses, result.position.rmse);
  return result;
}

}  // namespace sslam::io
