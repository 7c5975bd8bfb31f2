// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/compiled_kernels.hpp"

namespace sslam {

template class BundleSolver<SSLAM_SCALAR>;

}  // namespace sslam
