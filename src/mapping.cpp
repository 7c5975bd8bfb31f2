// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/mapping/mapping.hpp"
#include "sslam/map/map_adjustment.hpp"
#include "sslam/solver/bundle/bundle_solver.hpp"
#include "sslam/system/compiled_kernels.hpp"

namespace sslam {

extern template class Map<double>;
extern template class MapAdjustment<double, BundleSolver<double>>;

template class NewLandmarks<double>;
template class LandmarkFusion<double>;
template class ManhattanPlanes<double>;
template class KeyframeMapping<double>;
template class KeyframeMapping<double, MapAdjustment<double, BundleSolver<double>>, ManhattanPlanes<double>>;

}  // namespace sslam
