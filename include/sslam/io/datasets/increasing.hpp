// SPDX-License-Identifier: BSD-3-Clause
// Which entries of a list of stamps to drop, as few as possible, so that the rest strictly increases.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace sslam::io {

// keep[i] is false for each stamp to drop. Longest increasing subsequence by patience sorting, n log n; it
// blames one stray stamp, high or low, where comparing with the last stamp would blame all that follow a high
// one. Of equal neighbours the first is kept.
[[nodiscard]] inline std::vector<bool> keep_increasing(std::span<const double> stamps) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> tails;  // index of the smallest last stamp of a subsequence of each length
  std::vector<std::size_t> before(stamps.size(), kNone);
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const auto place = std::lower_bound(tails.begin(), tails.end(), stamps[i],
                                        [&](std::size_t tail, double stamp) { return stamps[tail] < stamp; });
    if (place != tails.begin()) before[i] = *(place - 1);
    if (place == tails.end()) {
      tails.push_back(i);
    } else if (stamps[i] < stamps[*place]) {
      *place = i;
    }
  }
  std::vector<bool> keep(stamps.size(), false);
  for (std::size_t i = tails.empty() ? kNone : tails.back(); i != kNone; i = before[i]) keep[i] = true;
  return keep;
}

}  // namespace sslam::io
