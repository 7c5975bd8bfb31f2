// SPDX-License-Identifier: BSD-3-Clause
#include "cli/stages.hpp"

namespace sslam {

template class NewLandmarks<double>;
template class LandmarkFusion<double>;
template class KeyframeMapping<double, NoOptimiser<double>>;
template class KeyframeMapping<double, LocalBundleAdjustment>;

}  // namespace sslam
