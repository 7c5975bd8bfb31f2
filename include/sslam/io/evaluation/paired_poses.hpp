// SPDX-License-Identifier: BSD-3-Clause
// Two trajectories of the same time, brought together pose by pose, and how their rotations differ.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sslam/geometry/nearest_rotation.hpp"
#include "sslam/io/evaluation/association.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::io {

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
                ") within " + exact_decimal(max_difference, 0) +
                ": another clock (--offset, --find-offset), or another recording?");
  }
  return paired;
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

}  // namespace sslam::io
