// SPDX-License-Identifier: BSD-3-Clause
// What a solver of graphs promises, whatever it was given.
#pragma once

#include <cmath>

#include "fuzz/spoilt_numbers.hpp"
#include "sslam/solver/bundle/bundle_solver.hpp"

namespace sslam::fuzzing {

// Whether the solver says that the graph is better, whose cost is finite and no higher then. Any other graph
// stays as it was: unchanged() says so.
template <class Unchanged>
[[nodiscard]] bool descended(const BundleSummary& summary, Unchanged unchanged) {
  if (!improved(summary)) {
    demand(unchanged());
    return false;
  }
  demand(std::isfinite(summary.final_cost) && summary.final_cost <= summary.initial_cost);
  return true;
}

}  // namespace sslam::fuzzing
