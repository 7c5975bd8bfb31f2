// SPDX-License-Identifier: BSD-3-Clause
// Bundle adjustment of the whole map, with Ceres.
#pragma once

#include "sslam/ceres/bundle_solver.hpp"
#include "sslam/map/bundle_write_back.hpp"

namespace sslam {

class GlobalBundleAdjustment {
 public:
  BundleWindowOptions<double> window_options;
  CeresBundleSolver solver;
  BundleWriteBack<double> write_back;

  GlobalBundleAdjustment() {
    solver.options.max_iterations = 30;
    solver.options.function_tolerance = 1e-6;
    solver.options.sparse = true;
  }

  // Leaves the map as it was when the solver fails or most observations disagree with its answer.
  BundleSummary optimise(Map<double>& map) {
    window_.gather_all(map, window_options);
    BundleSummary summary = solver.solve(window_.graph);
    if (improved(summary) && !write_back.write_back(window_, solver.options.losses, map))
      summary.status = Status::kNoConsensus;
    return summary;
  }

 private:
  BundleWindow<double> window_;
};

}  // namespace sslam
