// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/map/map_adjustment.hpp"
#include "sslam/solver/bundle/bundle_solver.hpp"
#include "sslam/system/compiled_kernels.hpp"

namespace sslam {

extern template class Map<double>;

template class MapAdjustment<double, BundleSolver<double>>;

}  // namespace sslam
