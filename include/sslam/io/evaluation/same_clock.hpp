// SPDX-License-Identifier: BSD-3-Clause
// Stamps whose unit shows only beside another list of the same time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "sslam/io/evaluation/association.hpp"
#include "sslam/io/files/stamp_unit.hpp"

namespace sslam::io {

// Whether one clock may have both: recordings of one walk last about as long, and stamps that begin with 0 in
// all units come together by chance.
[[nodiscard]] inline bool last_alike(std::span<const double> a, std::span<const double> b) {
  constexpr double kAlike = 20;  // an estimate may be of a part
  const auto [a_first, a_last] = std::minmax_element(a.begin(), a.end());
  const auto [b_first, b_last] = std::minmax_element(b.begin(), b.end());
  const double a_span = *a_last - *a_first, b_span = *b_last - *b_first;
  return a_span < kAlike * b_span && b_span < kAlike * a_span;
}

// The unit in which `stamps` fit `reference`, which is in seconds: another than seconds only where it brings
// far more of them together.
[[nodiscard]] inline StampUnit unit_on_clock(std::span<const double> reference,
                                             std::span<const double> stamps, double max_difference) {
  constexpr std::size_t kFewest = 3, kMoreOften = 4;
  StampUnit best;
  std::size_t most = associate(reference, stamps, max_difference).size();
  if (2 * most >= std::min(reference.size(), stamps.size())) return best;
  for (const StampUnit& unit : {kMilliseconds, kMicroseconds, kNanoseconds}) {
    std::vector<double> seconds(stamps.begin(), stamps.end());
    for (double& stamp : seconds) stamp /= unit.per_second;
    const std::size_t pairs = associate(reference, seconds, max_difference).size();
    if (pairs < kFewest || pairs < kMoreOften * most || !last_alike(reference, seconds)) continue;
    best = unit;
    most = pairs;
  }
  return best;
}

}  // namespace sslam::io
