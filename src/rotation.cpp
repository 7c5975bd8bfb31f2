// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/localise/rotation.hpp"
#include "sslam/system/compiled_kernels.hpp"

namespace sslam {

template class ManhattanRotation<double>;

}  // namespace sslam
