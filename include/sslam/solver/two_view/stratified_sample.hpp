// SPDX-License-Identifier: BSD-3-Clause
// A bounded sample of a list of any length: one random item from each of equal parts.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sslam/core/random.hpp"

namespace sslam {

// Index into a list of `size` items for the given one of `slots` <= size parts.
[[nodiscard]] constexpr std::size_t stratified_index(std::size_t slot, std::size_t slots, std::size_t size,
                                                     Random& random) noexcept {
  const std::size_t begin = slot * size / slots;
  const std::size_t end = (slot + 1) * size / slots;
  return begin + random.below(static_cast<std::uint32_t>(end - begin));
}

}  // namespace sslam
