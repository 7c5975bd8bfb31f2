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

#include "sslam/geometry/nearest_rotation.hpp"
#include "sslam/io/evaluation/alignment.hpp"
#include "sslam/io/evaluation/association.hpp"
#include "sslam/io/evaluation/statistics.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::io {

enum class DeltaUnit { kFrames, kSeconds };

// The step over which a relative error is taken.
struct Delta {
  double value = 1;
  DeltaUnit unit = DeltaUnit::kSeconds;
};

struct EvaluationOptions {
  Alignment alignment = Alignment::kSim3;
  double max_difference = kMaxStampDifference;  // between the stamps of a pair, in their unit
  double seconds_per_stamp = 1;                 // for deltas in seconds
  std::vector<double> frame_stamps{};  // of the images that could have been tracked; empty: not known
  std::size_t frames = 0;              // their number, where only that is known; 0: not known
  std::vector<Delta> deltas{{1, DeltaUnit::kFrames}, {1, DeltaUnit::kSeconds}};
};

struct RelativeError {
  Delta delta;
  Statistics translation;  // metres
  Statistics rotation;     // radians
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
  double truth_path = 0;     // metres along the paired ground truth poses
  double estimate_path = 0;  // the same along the estimate, after scaling
};

// Poses of both, paired by stamp, in time order.
struct PairedPoses {
  Trajectory truth;
  Trajectory estimate;
};

// Throws Error when there is no pair.
[[nodiscard]] inline PairedPoses pair_poses(const Trajectory& truth, const Trajectory& estimate,
                                            double max_difference) {
  if (truth.empty()) throw Error("the ground truth holds no pose");
  if (estimate.empty()) throw Error("the estimate holds no pose");
  PairedPoses paired;
  for (const StampPair& pair : associate(stamps_of(estimate), stamps_of(truth), max_difference)) {
    paired.estimate.push_back(estimate[pair.a]);
    paired.truth.push_back(truth[pair.b]);
  }
  if (paired.estimate.empty()) {
    throw Error("no overlap between ground truth (stamps " + exact_decimal(truth.front().stamp) + " to " +
                exact_decimal(truth.back().stamp) + ") and estimate (" +
                exact_decimal(estimate.front().stamp) + " to " + exact_decimal(estimate.back().stamp) +
                ") within " + exact_decimal(max_difference, 0));
  }
  return paired;
}

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

[[nodiscard]] inline std::vector<double> rotation_errors(const PairedPoses& paired,
                                                         const SO3<double>& truth_from_estimate) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < paired.truth.size(); ++i) {
    errors.push_back(angle_between(truth_from_estimate * paired.estimate[i].world_from_cam.rotation,
                                   paired.truth[i].world_from_cam.rotation));
  }
  return errors;
}

// The constant turn of the world closest to all rotations in the chordal sense (Hartley et al., IJCV
// 2013, 5.3).
[[nodiscard]] inline SO3<double> rotation_offset(const PairedPoses& paired) {
  Mat3<double> sum = Mat3<double>::Zero();
  for (std::size_t i = 0; i < paired.truth.size(); ++i) {
    sum += paired.truth[i].world_from_cam.rotation.matrix() *
           paired.estimate[i].world_from_cam.rotation.matrix().transpose();
  }
  // Where the nearest is not unique the rotations contradict each other, and no offset is better than none.
  SO3<double> offset;
  if (!usable(nearest_rotation(sum, offset))) return {};
  return offset;
}

// Index of the far end of the step that starts at pose i, as the TUM tools choose it: the pose nearest to the
// wanted place. They leave out every step that ends at the last pose, since it may have been cut short; so do
// we. Returns stamps.size() for none.
[[nodiscard]] inline std::size_t step_end(std::span<const double> stamps, std::size_t i, const Delta& delta,
                                          double seconds_per_stamp) {
  const std::size_t last = stamps.size() - 1;
  std::size_t j = last;
  if (delta.unit == DeltaUnit::kSeconds) {
    j = nearest_stamp(stamps, stamps[i] + delta.value / seconds_per_stamp);
  } else if (delta.value < static_cast<double>(last - i)) {
    j = i + static_cast<std::size_t>(std::lround(delta.value));
  }
  return j >= last || j <= i ? stamps.size() : j;
}

// E = (Q_i^-1 Q_j)^-1 (P_i^-1 P_j), with the estimate's translation scaled.
[[nodiscard]] inline RelativeError relative_error(const PairedPoses& paired, const Delta& delta, double scale,
                                                  double seconds_per_stamp) {
  std::vector<double> translation;
  std::vector<double> rotation;
  const std::vector<double> stamps = stamps_of(paired.estimate);
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const std::size_t j = step_end(stamps, i, delta, seconds_per_stamp);
    if (j == stamps.size()) continue;
    const SE3<double> true_step = paired.truth[i].world_from_cam.inverse() * paired.truth[j].world_from_cam;
    SE3<double> step = paired.estimate[i].world_from_cam.inverse() * paired.estimate[j].world_from_cam;
    step.translation *= scale;
    const SE3<double> error = true_step.inverse() * step;
    translation.push_back(error.translation.norm());
    rotation.push_back(angle_between(error.rotation, SO3<double>{}));
  }
  return {delta, statistics_of(translation), statistics_of(rotation)};
}

// Throws Error when the two do not overlap or cannot be aligned.
[[nodiscard]] inline Evaluation evaluate(const Trajectory& truth, const Trajectory& estimate,
                                         const EvaluationOptions& options = {}) {
  const PairedPoses paired = pair_poses(truth, estimate, options.max_difference);
  const std::vector<Vec3<double>> true_positions = positions_of(paired.truth);
  const std::vector<Vec3<double>> positions = positions_of(paired.estimate);
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
  return result;
}

}  // namespace sslam::io
