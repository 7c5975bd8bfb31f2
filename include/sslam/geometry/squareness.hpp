// SPDX-License-Identifier: BSD-3-Clause
// How far single walls and edges of buildings deviate from their Manhattan axes: standard deviations,
// radians.
#pragma once

#include "sslam/core/types.hpp"

namespace sslam {

template <Scalar S>
inline constexpr S kWallTilt = radians(S(0.3));  // of a wall's normal
template <Scalar S>
inline constexpr S kEdgeTilt = radians(S(0.15));  // of an edge's direction

}  // namespace sslam
