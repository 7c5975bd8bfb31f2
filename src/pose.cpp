// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/compiled_kernels.hpp"
#include "sslam/track/localise/fallback.hpp"
#include "sslam/track/localise/refinement.hpp"
#include "sslam/track/localise/relocalisation.hpp"
#include "sslam/track/localise/translation.hpp"

namespace sslam {

template class DecoupledTranslation<double>;
template class FeatureFallback<double>;
template class LocalMapRefinement<double>;
template class Relocalisation<double>;

}  // namespace sslam
