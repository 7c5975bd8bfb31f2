// SPDX-License-Identifier: BSD-3-Clause
// The summary of a list of errors that the TUM tools print.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sslam::io {

struct Statistics {
  std::size_t count = 0;  // with 0, everything else is 0 too
  double rmse = 0;
  double mean = 0;
  double median = 0;
  double deviation = 0;  // standard deviation of the population
  double min = 0;
  double max = 0;
};

// p in [0, 1]: linear between the two nearest ranks, as numpy does. values: sorted, not empty.
[[nodiscard]] inline double quantile(const std::vector<double>& values, double p) noexcept {
  const double rank = p * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(rank);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (rank - static_cast<double>(low)) * (values[high] - values[low]);
}

[[nodiscard]] inline Statistics statistics_of(std::vector<double> values) {
  Statistics result;
  result.count = values.size();
  if (values.empty()) return result;
  std::sort(values.begin(), values.end());
  double sum = 0;
  double squares = 0;
  for (const double value : values) {
    sum += value;
    squares += value * value;
  }
  const double n = static_cast<double>(values.size());
  result.rmse = std::sqrt(squares / n);
  result.mean = sum / n;
  result.median = quantile(values, 0.5);
  double spread = 0;
  for (const double value : values) spread += (value - result.mean) * (value - result.mean);
  result.deviation = std::sqrt(spread / n);
  result.min = values.front();
  result.max = values.back();
  return result;
}

}  // namespace sslam::io
