// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/mapping/initialisation.hpp"
#include "sslam/system/compiled_kernels.hpp"

namespace sslam {

extern template class Map<double>;

template class DecoupledInitialisation<double>;

}  // namespace sslam
