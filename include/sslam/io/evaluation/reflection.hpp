// SPDX-License-Identifier: BSD-3-Clause
// Whether a trajectory is a mirror image of another one: a world with its left hand for its right, as of a
// negated axis. No rotation brings the two together.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "sslam/io/evaluation/alignment.hpp"
#include "sslam/io/evaluation/paired_poses.hpp"
#include "sslam/io/evaluation/statistics.hpp"

namespace sslam::io {

// The error of the positions, root mean square, after the best alignment with a reflection.
[[nodiscard]] inline double reflected_rmse(std::vector<Vec3<double>> estimate,
                                           const std::vector<Vec3<double>>& truth, Alignment alignment) {
  for (Vec3<double>& position : estimate) position.x() *= -1;
  const Sim3<double> truth_from_mirror = align(estimate, truth, alignment);
  std::vector<double> errors;
  errors.reserve(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i)
    errors.push_back((truth_from_mirror * estimate[i] - truth[i]).norm());
  return statistics_of(errors).rmse;
}

// What to say of a mirror image; empty: it is none. `rmse`: of the positions after the alignment, which is
// not kNone, of at least three pairs. A path in a plane is its own mirror image: there it does not tell.
[[nodiscard]] inline std::string reflection_note(const PairedPoses& paired, Alignment alignment,
                                                 double rmse) {
  constexpr double kBetter = 0.25, kNothing = 1e-6;  // of the error; of the path
  const std::vector<Vec3<double>> truth = positions_of(paired.truth),
                                  estimate = positions_of(paired.estimate);
  const double other = reflected_rmse(estimate, truth, alignment);
  if (rmse <= kNothing * spread_of(truth) || other >= kBetter * rmse) return {};
  char text[320];
  std::snprintf(text, sizeof text,
                "the estimate is a mirror image of the ground truth: with a reflection the position error "
                "would be %.4g m instead of %.4g m; one of the two has a negated axis (ground truth with y "
                "up: --axes)",
                other, rmse);
  return text;
}

}  // namespace sslam::io
