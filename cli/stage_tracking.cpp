// SPDX-License-Identifier: BSD-3-Clause
#include "cli/stages.hpp"

namespace sslam {

template class DecoupledTranslation<double>;
template class FeatureFallback<double>;
template class LocalMapRefinement<double>;

}  // namespace sslam
