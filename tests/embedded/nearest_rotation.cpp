// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/geometry/nearest_rotation.hpp"

namespace sslam::embedded {

Status run_nearest_rotation(const Mat3<float>& m, SO3<float>& out) noexcept {
  return nearest_rotation(m, out);
}

}  // namespace sslam::embedded
