// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/compiled_stages.hpp"

namespace sslam {

template class NewLandmarks<double>;
template class LandmarkFusion<double>;
template class ManhattanPlanes<double>;
template class KeyframeMapping<double>;
template class KeyframeMapping<double, MapAdjustment<double, BundleSolver<double>>, ManhattanPlanes<double>>;

}  // namespace sslam
