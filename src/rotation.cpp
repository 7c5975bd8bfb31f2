// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/compiled_stages.hpp"

namespace sslam {

template class ManhattanRotation<double>;

}  // namespace sslam
