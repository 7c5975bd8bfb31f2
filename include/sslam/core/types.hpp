// SPDX-License-Identifier: BSD-3-Clause
// The scalar concept and the short names for the small Eigen types that every floor shares.
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <numbers>

namespace sslam {

template <class S>
concept Scalar = std::same_as<S, float> || std::same_as<S, double>;

template <Scalar S, int N>
using Vec = Eigen::Matrix<S, N, 1>;
template <Scalar S, int R, int C>
using Mat = Eigen::Matrix<S, R, C>;

template <Scalar S>
using Vec2 = Vec<S, 2>;
template <Scalar S>
using Vec3 = Vec<S, 3>;
template <Scalar S>
using Vec4 = Vec<S, 4>;
template <Scalar S>
using Vec6 = Vec<S, 6>;
template <Scalar S>
using Mat2 = Mat<S, 2, 2>;
template <Scalar S>
using Mat3 = Mat<S, 3, 3>;
template <Scalar S>
using Mat6 = Mat<S, 6, 6>;

template <Scalar S>
[[nodiscard]] constexpr S radians(S degrees) noexcept {
  return degrees * std::numbers::pi_v<S> / S(180);
}

template <Scalar S>
[[nodiscard]] constexpr S degrees(S radians) noexcept {
  return radians * S(180) / std::numbers::pi_v<S>;
}

}  // namespace sslam
