// SPDX-License-Identifier: BSD-3-Clause
// The smallest of the repetitions, beside the median that the benchmark library gives: what a busy machine
// disturbs least.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

namespace sslam::bench {

inline void with_smallest(benchmark::internal::Benchmark* bench) {
  bench->ComputeStatistics(
      "min", [](const std::vector<double>& v) -> double { return *std::min_element(v.begin(), v.end()); });
}

}  // namespace sslam::bench
