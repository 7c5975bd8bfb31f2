// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/compiled_stages.hpp"

namespace sslam {

template class DecoupledTranslation<double>;
template class FeatureFallback<double>;
template class LocalMapRefinement<double>;
template class Relocalisation<double>;

}  // namespace sslam
