// SPDX-License-Identifier: BSD-3-Clause
// Where numbers along a line crowd together: the mode of a one-dimensional density under a box kernel, and
// how far it stands out.
#pragma once

#include <cstddef>
#include <span>

#include "sslam/core/types.hpp"

namespace sslam {

template <Scalar S>
struct OffsetMode {
  std::size_t first = 0, last = 0;  // its numbers: [first, last) of the sorted list
  S contrast = 0;  // how many they are over how many the surroundings make expect, at least one of these

  [[nodiscard]] std::size_t size() const noexcept { return last - first; }
};

// The stretch of the given width that holds most of the numbers, which are sorted; the first of equals. Its
// surroundings reach two widths to either side: a crowd among crowds is clutter.
template <Scalar S>
[[nodiscard]] OffsetMode<S> offset_mode(std::span<const S> sorted, S width) noexcept {
  OffsetMode<S> best;
  for (std::size_t first = 0, last = 0; first < sorted.size(); ++first) {
    while (last < sorted.size() && sorted[last] - sorted[first] <= width) ++last;
    if (last - first > best.size()) best = {first, last, 0};
  }
  if (best.size() == 0) return best;
  constexpr S kReach = 2;
  std::size_t around = 0;
  for (const S x : sorted)
    around += x >= sorted[best.first] - kReach * width && x <= sorted[best.last - 1] + kReach * width;
  const S expected = static_cast<S>(around - best.size()) / (2 * kReach);
  best.contrast = static_cast<S>(best.size()) / (expected > 1 ? expected : S(1));
  return best;
}

}  // namespace sslam
