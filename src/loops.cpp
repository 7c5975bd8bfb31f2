// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/compiled_kernels.hpp"
#include "sslam/track/loops/loop_closing.hpp"

namespace sslam {

extern template class Map<double>;
extern template class MapAdjustment<double, BundleSolver<double>>;
extern template class FeatureFallback<double>;
extern template class LocalMapRefinement<double>;
extern template class LandmarkFusion<double>;

template class PoseGraphSolver<double>;
template class EssentialGraph<double>;
template class LoopDetection<double>;
template class LoopClosing<double>;

}  // namespace sslam
