// SPDX-License-Identifier: BSD-3-Clause
// The unit that stamps count: seconds, unless their size or their steps can only be those of a finer one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sslam::io {

struct StampUnit {
  std::string_view name = "seconds";
  double per_second = 1;

  [[nodiscard]] constexpr bool is_seconds() const noexcept { return per_second == 1; }
};

inline constexpr StampUnit kMilliseconds{"milliseconds", 1e3}, kMicroseconds{"microseconds", 1e6},
    kNanoseconds{"nanoseconds", 1e9};

// Whose stamps they are. Steps of tens between images are milliseconds; poses may be tens of seconds apart,
// and numbers in names may be counters.
enum class StampsOf { kImages, kOther };

// Between neighbours in time; 0 where there are too few to tell.
[[nodiscard]] inline double median_step(std::span<const double> stamps) {
  constexpr std::size_t kEnough = 3;
  std::vector<double> sorted(stamps.begin(), stamps.end());
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> steps;
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] > sorted[i - 1]) steps.push_back(sorted[i] - sorted[i - 1]);
  if (steps.size() < kEnough) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

[[nodiscard]] inline StampUnit stamp_unit_of(std::span<const double> stamps, StampsOf whose) {
  double largest = 0;
  bool whole = true;
  for (const double stamp : stamps) {
    largest = std::max(largest, std::abs(stamp));
    whole = whole && stamp == std::floor(stamp);
  }
  // Since 1970: 1e9 seconds have passed, 1e12 milliseconds, 1e15 microseconds, 1e18 nanoseconds.
  if (largest >= 1e17) return kNanoseconds;
  if (largest >= 1e14) return kMicroseconds;
  if (largest >= 1e11) return kMilliseconds;
  // Since some start: between 2 ms and 1.5 s from one to the next.
  const double step = median_step(stamps);
  if (whole && step >= 1.5e6) return kNanoseconds;
  if (whole && step >= 2e3) return kMicroseconds;
  if (whose == StampsOf::kImages && step >= 10) return kMilliseconds;
  return {};
}

// What a reader says that has turned them into seconds.
[[nodiscard]] inline std::string unit_note(const StampUnit& unit) {
  return "stamps in " + std::string(unit.name) + ", taken as such: seconds in all that is written";
}

}  // namespace sslam::io
