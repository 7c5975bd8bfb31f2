// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/compiled_kernels.hpp"

namespace sslam {

SSLAM_TRIANGULATION_KERNELS(, SSLAM_SCALAR)
SSLAM_POSE_KERNELS(, SSLAM_SCALAR)

}  // namespace sslam
