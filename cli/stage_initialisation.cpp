// SPDX-License-Identifier: BSD-3-Clause
#include "cli/stages.hpp"

namespace sslam {

template class DecoupledInitialisation<double>;

}  // namespace sslam
