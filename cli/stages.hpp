// SPDX-License-Identifier: BSD-3-Clause
// The pipeline's stages are instantiated once for the command line, each in a file of its own, instead of once for
// every preset.
#pragma once

#include "sslam/ceres/local_bundle_adjustment.hpp"
#include "sslam/track/presets.hpp"

namespace sslam {

extern template class ManhattanRotation<double>;        // stage_rotation.cpp
extern template class DecoupledInitialisation<double>;  // stage_initialisation.cpp
extern template class DecoupledTranslation<double>;     // stage_tracking.cpp
extern template class FeatureFallback<double>;          // stage_tracking.cpp
extern template class LocalMapRefinement<double>;       // stage_tracking.cpp
extern template class KeyframeMapping<double, NoOptimiser<double>>;    // stage_mapping.cpp
extern template class KeyframeMapping<double, LocalBundleAdjustment>;  // stage_mapping.cpp
extern template class NewLandmarks<double>;             // stage_mapping.cpp
extern template class LandmarkFusion<double>;           // stage_mapping.cpp

}  // namespace sslam
