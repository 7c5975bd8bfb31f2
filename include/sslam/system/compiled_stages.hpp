// SPDX-License-Identifier: BSD-3-Clause
// The stages compiled for `double` in sslam::stages: a program that includes this and links it does not
// compile them, in any pipeline.
#pragma once

#include "sslam/system/compiled_kernels.hpp"
#include "sslam/track/presets.hpp"

namespace sslam {

extern template class Map<double>;  // src/map.cpp

extern template class ManhattanRotation<double>;        // src/rotation.cpp
extern template class DecoupledInitialisation<double>;  // src/initialisation.cpp
extern template class DecoupledTranslation<double>;     // src/pose.cpp
extern template class FeatureFallback<double>;          // src/pose.cpp
extern template class LocalMapRefinement<double>;       // src/pose.cpp
extern template class Relocalisation<double>;           // src/pose.cpp
extern template class NewLandmarks<double>;             // src/mapping.cpp
extern template class LandmarkFusion<double>;           // src/mapping.cpp
extern template class ManhattanPlanes<double>;          // src/mapping.cpp
extern template class KeyframeMapping<double>;          // src/mapping.cpp
extern template class KeyframeMapping<double, MapAdjustment<double, BundleSolver<double>>,
                                      ManhattanPlanes<double>>;     // src/mapping.cpp
extern template class MapAdjustment<double, BundleSolver<double>>;  // src/adjustment.cpp
extern template class EssentialGraph<double>;                       // src/loops.cpp
extern template class LoopDetection<double>;                        // src/loops.cpp
extern template class LoopClosing<double>;                          // src/loops.cpp

}  // namespace sslam
