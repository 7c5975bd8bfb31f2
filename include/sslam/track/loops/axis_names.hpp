// SPDX-License-Identifier: BSD-3-Clause
// What the Manhattan axes of one map are called in another, once it is known how both worlds stand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sslam/manhattan/nearest_frame.hpp"
#include "sslam/map/manhattan_axes.hpp"

namespace sslam {

template <Scalar S>
struct AxisNames {
  SO3<S> into_from_other;            // exact where both worlds have a Manhattan frame in common
  std::vector<std::int8_t> renamed;  // by the number of an axis in the other map

  [[nodiscard]] std::int8_t operator()(std::int8_t number) const noexcept {
    return number == kNone ? std::int8_t{kNone} : renamed[static_cast<std::size_t>(number)];
  }
};

// Frames of the other world within `max_turn`, radians, of one of `into` are the same; the rest are added to
// `into`. `into_from_other` is the rotation as it was measured.
template <Scalar S>
[[nodiscard]] AxisNames<S> name_axes(std::vector<SO3<S>>& into, const std::vector<SO3<S>>& other,
                                     const SO3<S>& into_from_other, S max_turn) {
  AxisNames<S> names{into_from_other, {}};
  for (const SO3<S>& frame : other) {
    const auto same = nearest_frame(into, into_from_other * frame, max_turn);
    if (!same) continue;
    names.into_from_other = closest_naming(into[*same], into_from_other * frame) * frame.inverse();
    break;
  }
  for (const SO3<S>& frame : other) {
    const SO3<S> placed = names.into_from_other * frame;
    std::size_t index = into.size();
    Mat3<S> own_from_other = Mat3<S>::Identity();  // a signed permutation
    if (const auto same = nearest_frame(into, placed, max_turn)) {
      index = *same;
      own_from_other = nearest_cube_rotation<S>((placed.inverse() * into[index]).matrix()).transpose();
    } else {
      into.push_back(placed);
    }
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Index own = 0;
      own_from_other.col(axis).cwiseAbs().maxCoeff(&own);
      names.renamed.push_back(axis_number(into, index, static_cast<std::int8_t>(own)));
    }
  }
  return names;
}

}  // namespace sslam
