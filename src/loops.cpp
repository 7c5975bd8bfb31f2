// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/system/compiled_stages.hpp"

namespace sslam {

template class PoseGraphSolver<double>;
template class EssentialGraph<double>;
template class LoopDetection<double>;
template class LoopClosing<double>;

}  // namespace sslam
