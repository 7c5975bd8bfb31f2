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
    if (pairs < kFewest || pairs < kMoreOften * most) continue;
    best = unit;
    most = pairs;
  }
  return best;
}

}  // namespace sslam::io
