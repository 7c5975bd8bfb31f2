// SPDX-License-Identifier: BSD-3-Clause
// The result of a stage that estimates a frame's pose.
#pragma once

#include "sslam/track/contract/result.hpp"

namespace sslam {

template <Scalar S>
struct PoseEstimate {
  Reason reason = Reason::kTooFewMatches;  // kFine: the pose may be used
  int point_inliers = 0;
  int line_inliers = 0;
  Mat6<S> covariance = Mat6<S>::Zero();  // as in TrackResult; zero: not in six degrees of freedom
  S scene_depth = 0;                     // median depth of the landmarks it was solved from; 0: not known

  [[nodiscard]] bool ok() const noexcept { return reason == Reason::kFine; }
};

}  // namespace sslam
