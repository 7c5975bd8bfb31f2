// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/solver/modes/mean_shift.hpp"

namespace sslam::embedded {

void run_frame_moments(const DirectionView<float>& votes, const Mat3<float>& cam_from_axes, float width,
                       FrameMoments<float>& out) noexcept {
  out = frame_moments(votes, cam_from_axes, width);
}

}  // namespace sslam::embedded
