// SPDX-License-Identifier: BSD-3-Clause
// The middle of a list of numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "sslam/core/types.hpp"

namespace sslam {

// The upper one of two middles. Reorders the values, of which there must be one at least.
template <Scalar S>
[[nodiscard]] S median(std::span<S> values) noexcept {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace sslam
