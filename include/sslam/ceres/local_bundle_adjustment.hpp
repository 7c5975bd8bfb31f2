// SPDX-License-Identifier: BSD-3-Clause
// Bundle adjustment around a new keyframe, with Ceres: a MapOptimiser for KeyframeMapping.
// MapAdjustment<double> is the same with the core's own solver, several times as fast.
#pragma once

#include "sslam/ceres/bundle_solver.hpp"
#include "sslam/map/map_adjustment.hpp"

namespace sslam {

using LocalBundleAdjustment = MapAdjustment<double, CeresBundleSolver>;

}  // namespace sslam
