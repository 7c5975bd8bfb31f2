// SPDX-License-Identifier: BSD-3-Clause
// Pairs the entries of two clocks by nearest stamp, as the associate.py of the TUM RGB-D benchmark does.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <queue>
#include <span>
#include <tuple>
#include <vector>

namespace sslam::io {

// 20 ms: the default of the TUM tools.
inline constexpr double kMaxStampDifference = 0.02;

struct StampPair {
  std::size_t a = 0;
  std::size_t b = 0;
};

// Index of the stamp nearest to `stamp`, the lower of two equally near. stamps: increasing, not empty.
[[nodiscard]] inline std::size_t nearest_stamp(std::span<const double> stamps, double stamp) noexcept {
  const auto above = std::lower_bound(stamps.begin(), stamps.end(), stamp);
  const auto at = static_cast<std::size_t>(above - stamps.begin());
  if (at == 0) return 0;
  if (at == stamps.size()) return at - 1;
  return stamps[at] - stamp < stamp - stamps[at - 1] ? at : at - 1;
}

// Greedy: the closest pair of all first, then the closest among the rest, each entry used once, down to pairs
// less than max_difference apart. Both lists increasing. Result in increasing order of a.
[[nodiscard]] inline std::vector<StampPair> associate(std::span<const double> a, std::span<const double> b,
                                                      double max_difference = kMaxStampDifference) {
  using Candidate = std::tuple<double, std::size_t, std::size_t>;  // difference, index in a, index in b
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue;
  std::vector<bool> used(b.size(), false);
  // One candidate of each entry of a waits in the queue: the nearest entry of b that was free when it was
  // pushed.
  const auto push_nearest = [&](std::size_t i) {
    const auto first_above = std::lower_bound(b.begin(), b.end(), a[i]) - b.begin();
    std::ptrdiff_t below = first_above - 1;
    std::ptrdiff_t above = first_above;
    const auto size = static_cast<std::ptrdiff_t>(b.size());
    while (below >= 0 && used[static_cast<std::size_t>(below)] &&
           a[i] - b[static_cast<std::size_t>(below)] < max_difference)
      --below;
    while (above < size && used[static_cast<std::size_t>(above)] &&
           b[static_cast<std::size_t>(above)] - a[i] < max_difference)
      ++above;
    Candidate best{max_difference, i, 0};
    for (const std::ptrdiff_t j : {below, above}) {
      if (j < 0 || j >= size || used[static_cast<std::size_t>(j)]) continue;
      const double difference = std::abs(a[i] - b[static_cast<std::size_t>(j)]);
      if (difference < std::get<0>(best)) best = {difference, i, static_cast<std::size_t>(j)};
    }
    if (std::get<0>(best) < max_difference) queue.push(best);
  };
  for (std::size_t i = 0; i < a.size(); ++i) push_nearest(i);

  std::vector<StampPair> pairs;
  while (!queue.empty()) {
    const auto [difference, i, j] = queue.top();
    queue.pop();
    if (used[j]) {
      push_nearest(i);
      continue;
    }
    used[j] = true;
    pairs.push_back({i, j});
  }
  std::sort(pairs.begin(), pairs.end(), [](const StampPair& p, const StampPair& q) { return p.a < q.a; });
  return pairs;
}

}  // namespace sslam::io
