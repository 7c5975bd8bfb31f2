// SPDX-License-Identifier: BSD-3-Clause
// Bundle adjustment around a new keyframe, with Ceres: a MapOptimiser for KeyframeMapping.
#pragma once

#include "sslam/ceres/bundle_solver.hpp"
#include "sslam/map/bundle_write_back.hpp"

namespace sslam {

class LocalBundleAdjustment {
 public:
  BundleWindowOptions<double> window_options;
  CeresBundleSolver solver;
  BundleWriteBack<double> write_back;

  // Leaves the map as it was when the solver fails or most observations disagree with its answer.
  BundleSummary optimise(Map<double>& map, KeyframeId keyframe) {
    window_.gather_local(map, keyframe, window_options);
    BundleSummary summary = solver.solve(window_.graph);
    if (improved(summary) && !write_back.write_back(window_, solver.options.losses, map))
      summary.status = Status::kNoConsensus;
    return summary;
  }

 private:
  BundleWindow<double> window_;
};

}  // namespace sslam
