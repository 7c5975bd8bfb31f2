// SPDX-License-Identifier: BSD-3-Clause
// ROS's worlds have z up, our maps y down. Cameras' axes are the same: those of ROS's optical frames.
#pragma once

#include <cmath>

#include "sslam/geometry/se3.hpp"

namespace sslam::io {

// x stays, z is up (the map's -y).
[[nodiscard]] inline SE3<double> upright_from_map() {
  SE3<double> turn;
  turn.rotation = SO3<double>::from_quaternion(std::sqrt(0.5), -std::sqrt(0.5), 0, 0);
  return turn;
}

}  // namespace sslam::io
