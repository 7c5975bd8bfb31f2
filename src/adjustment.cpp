// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/compiled_stages.hpp"

namespace sslam {

template class BundleSolver<double>;
template class MapAdjustment<double, BundleSolver<double>>;

}  // namespace sslam
