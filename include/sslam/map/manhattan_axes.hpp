// SPDX-License-Identifier: BSD-3-Clause
// The axes of all Manhattan frames of a world, by one number each: three to a frame, in order. Frames that
// share an axis, as two wings of a building share the vertical, share the number of the first of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sslam/geometry/so3.hpp"
#include "sslam/map/landmark.hpp"

namespace sslam {

inline constexpr double kSameAxisDegrees = 2;

// Direction in the world.
template <Scalar S>
[[nodiscard]] Vec3<S> axis_direction(const std::vector<SO3<S>>& world_from_manhattan, std::int8_t number) {
  return world_from_manhattan[static_cast<std::size_t>(number / 3)].matrix().col(number % 3);
}

// Of axis 0, 1 or 2 of a frame; kNone for none.
template <Scalar S>
[[nodiscard]] std::int8_t axis_number(const std::vector<SO3<S>>& world_from_manhattan, std::size_t frame,
                                      std::int8_t axis) {
  if (axis == kNone) return kNone;
  const auto own = static_cast<std::int8_t>(3 * frame + static_cast<std::size_t>(axis));
  const Vec3<S> direction = axis_direction(world_from_manhattan, own);
  const S least = std::cos(radians(S(kSameAxisDegrees)));
  for (std::int8_t other = 0; other < static_cast<std::int8_t>(3 * frame); ++other)
    if (std::abs(direction.dot(axis_direction(world_from_manhattan, other))) > least) return other;
  return own;
}

// Whether an axis has its own number, and not that of an earlier frame which shares it.
template <Scalar S>
[[nodiscard]] bool stands_for_itself(const std::vector<SO3<S>>& world_from_manhattan, std::int8_t own) {
  const auto axis = static_cast<std::int8_t>(own % 3);
  return axis_number(world_from_manhattan, static_cast<std::size_t>(own / 3), axis) == own;
}

// The axis of its own frame, 0, 1 or 2, that a number stands for; kNone for none.
[[nodiscard]] constexpr std::int8_t axis_in_frame(std::int8_t number) noexcept {
  return static_cast<std::int8_t>(number == kNone ? kNone : number % 3);
}

}  // namespace sslam
