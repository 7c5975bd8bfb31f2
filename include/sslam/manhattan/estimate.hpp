// SPDX-License-Identifier: BSD-3-Clause
// What a Manhattan rotation kernel is told and what it answers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sslam/core/status.hpp"
#include "sslam/geometry/so3.hpp"

namespace sslam {

// One set of values serves a network's normals (scatter 5-15 degrees) and normals from depth (1-2 degrees),
// since the spread of the votes is measured in every frame. Angles in radians.
template <Scalar S>
struct ManhattanOptions {
  S widest_kernel =
      radians(S(7));  // first kernel width: a cone of 24 degrees, more than the error of a prediction
  S narrowest_kernel = radians(S(2));  // last kernel width on clean normals: a cone of 7 degrees
  S kernel_per_scatter = S(1.2);       // kernel width in units of the measured scatter of the votes
  S normal_correlation =
      S(0.05);  // errors of one plane's normals have this much in common: N count as 1 / 0.05
  S normal_floor =
      radians(S(0.3));           // standard deviation of a plane's direction that no number of votes removes
  S min_normal_share = S(0.05);  // an axis is seen by normals that make up this share of all
  S line_floor = radians(S(0.15));  // how well real edges keep to their axis: added to each segment's sigma
  S widest_line_gate = radians(S(4));  // added to each segment's sigma at first, halved in every round
  S min_line_gain = S(8);  // an axis is seen by lines that are exp(8) times likelier with it than by chance
  S max_deviation = radians(S(3));  // every rotation is observed, by votes alone, to this standard deviation
  S max_jump = radians(S(45));      // a turn from the prior by more than this is a flip, not a motion
  std::size_t coarse_every = 8;     // while the kernel narrows, one block of normals in so many is read
};

// The predicted rotation, and how far it may be off: the covariance of its left perturbation, camera frame,
// rad^2. It fills the directions that no vote observes.
template <Scalar S>
struct ManhattanPrior {
  SO3<S> cam_from_manhattan;
  Mat3<S> covariance = Mat3<S>::Identity() * (radians(S(10)) * radians(S(10)));
};

template <Scalar S>
struct AxisSupport {
  bool seen = false;     // by normals or by lines
  S normal_share = 0;    // share of all normals that belong to this axis, without the clutter under its cone
  S normal_scatter = 0;  // standard deviation of those normals about their mode, per component, radians
  Vec2<S> mode =
      Vec2<S>::Zero();  // where the normals' mode lies off the final axis k, along axes k+1 and k+2, radians
  S lines = 0;          // number of segments, each counted by its probability to belong to this axis
  S line_gain = 0;      // log-likelihood of the segments with this axis over that without it
};

template <Scalar S>
struct ManhattanEstimate {
  Status status = Status::kTooFew;
  SO3<S> cam_from_manhattan;  // the columns are the axes in the camera frame; the prior where the status says
                              // failure
  Mat3<S> covariance = Mat3<S>::Zero();  // of the left perturbation, camera frame, rad^2, prior included
  int axes_seen = 0;
  std::array<AxisSupport<S>, 3> axes{};
  S line_rms =
      0;  // residual of the segments on an axis over their sigma, root mean square (1 is as promised)
  S deviation = 0;       // standard deviation of the worst observed rotation by the votes alone, radians
  S log_likelihood = 0;  // find_manhattan: of the votes, over that of votes without any common axes
  S ambiguity = 0;  // find_manhattan: the same of the second best frame, as a share of the best; 0 if none
};

}  // namespace sslam
