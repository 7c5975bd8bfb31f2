// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/map/map.hpp"
#include "sslam/system/compiled_kernels.hpp"

namespace sslam {

template class Map<double>;

}  // namespace sslam
