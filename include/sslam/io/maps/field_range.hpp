// SPDX-License-Identifier: BSD-3-Clause
// What a field of a file may hold: a reader refuses everything else.
#pragma once

#include <limits>
#include <string>
#include <type_traits>

#include "sslam/core/error.hpp"
#include "sslam/core/shortest_text.hpp"

namespace sslam::io {

template <class T>
requires std::is_arithmetic_v<T>
struct FieldRange {
  const char* name;  // of the field, for people
  T least = std::numeric_limits<T>::lowest();
  T most = std::numeric_limits<T>::max();

  // Not NaN either.
  [[nodiscard]] bool holds(T value) const noexcept { return value >= least && value <= most; }

  // Throws Error when it does not hold the value.
  void demand(T value) const {
    if (holds(value)) return;
    throw Error(std::string(name) + " is " + shortest_text(value) + "; expected " + shortest_text(least) +
                " to " + shortest_text(most));
  }
};

}  // namespace sslam::io
