// SPDX-License-Identifier: BSD-3-Clause
#include "cli/stages.hpp"

namespace sslam {

template class ManhattanRotation<double>;

}  // namespace sslam
