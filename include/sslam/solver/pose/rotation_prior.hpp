// SPDX-License-Identifier: BSD-3-Clause
// A rotation that is known before the pose is solved for.
#pragma once

#include "sslam/geometry/so3.hpp"

namespace sslam {

// What structure says about the rotation: a mean and the information of its left perturbation (camera frame,
// rad^-2).
template <Scalar S>
struct RotationPrior {
  SO3<S> cam_from_world;
  Mat3<S> information;
};

}  // namespace sslam
