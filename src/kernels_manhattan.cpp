// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/compiled_kernels.hpp"

namespace sslam {

SSLAM_MANHATTAN_KERNELS(, SSLAM_SCALAR)

}  // namespace sslam
