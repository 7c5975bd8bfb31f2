// SPDX-License-Identifier: BSD-3-Clause
// Bundle adjustment of the whole map, with Ceres: sparse, for maps of hundreds of keyframes.
#pragma once

#include "sslam/ceres/bundle_solver.hpp"
#include "sslam/map/map_adjustment.hpp"

namespace sslam {

class GlobalBundleAdjustment {
 public:
  MapAdjustment<double, CeresBundleSolver> adjustment;

  GlobalBundleAdjustment() {
    CeresBundleOptions& o = adjustment.solver.options;
    o.max_iterations = 30;
    o.function_tolerance = 1e-6;
    o.sparse = true;
  }

  BundleSummary optimise(Map<double>& map) { return adjustment.optimise_all(map); }
};

}  // namespace sslam
