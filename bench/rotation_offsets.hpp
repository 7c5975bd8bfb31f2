// SPDX-License-Identifier: BSD-3-Clause
// Rotation errors of a run against the truth, without what no rotation estimator can know: how the Manhattan
// frame lies in the world of the truth, and how the source of normals is turned against the camera.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sslam/geometry/so3.hpp"

namespace sslam::bench {

struct RotationPair {
  SO3<double> cam_from_manhattan;  // estimate
  SO3<double> cam_from_world;      // truth
};

// estimate ~ left * truth * right.
struct RotationOffsets {
  SO3<double> left, right;
};

// The offsets that minimise the sum of the angles (Weiszfeld's iteration on SO(3)), from the start where that
// sum is smallest. Without `with_left` the left one stays the identity.
[[nodiscard]] inline RotationOffsets find_offsets(const std::vector<RotationPair>& run, bool with_left) {
  constexpr int kRounds = 50;
  constexpr std::size_t kStarts = 20;
  constexpr double kNear = 1e-3;  // radians: keeps the weight of a perfect frame finite
  RotationOffsets best;
  double best_sum = -1;
  for (std::size_t s = 0; s < run.size(); s += std::max<std::size_t>(run.size() / kStarts, 1)) {
    RotationOffsets now;
    now.right = run[s].cam_from_world.inverse() * run[s].cam_from_manhattan;
    double sum = 0;
    for (int round = 0; round < kRounds; ++round) {
      Vec3<double> pull = Vec3<double>::Zero();
      Vec3<double> left_pull = Vec3<double>::Zero();
      double weight = 0;
      sum = 0;
      for (const RotationPair& pair : run) {
        const SO3<double> predicted = now.left * pair.cam_from_world;
        const Vec3<double> off = (predicted.inverse() * pair.cam_from_manhattan * now.right.inverse()).log();
        const double w = 1 / (kNear + off.norm());
        pull += w * off;
        left_pull += w * (predicted * off);
        weight += w;
        sum += off.norm();
      }
      const bool turn_left = with_left && round % 2 == 1;
      if (turn_left)
        now.left = SO3<double>::exp(left_pull / weight) * now.left;
      else
        now.right = SO3<double>::exp(pull / weight) * now.right;
    }
    if (best_sum >= 0 && sum >= best_sum) continue;
    best_sum = sum;
    best = now;
  }
  return best;
}

// Angles between estimate and truth, radians, in the order of the run.
[[nodiscard]] inline std::vector<double> rotation_errors(const std::vector<RotationPair>& run,
                                                         const RotationOffsets& offsets) {
  std::vector<double> errors;
  for (const RotationPair& pair : run) {
    const SO3<double> predicted = offsets.left * pair.cam_from_world * offsets.right;
    errors.push_back(angle_between(predicted, pair.cam_from_manhattan));
  }
  return errors;
}

}  // namespace sslam::bench
