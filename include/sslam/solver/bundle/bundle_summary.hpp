// SPDX-License-Identifier: BSD-3-Clause
// How a bundle adjustment, or the adjustment of a pose graph, went.
#pragma once

#include "sslam/core/status.hpp"

namespace sslam {

struct BundleSummary {
  Status status =
      Status::kTooFew;  // kOk and kNotConverged: the graph holds the better state; otherwise it is as it was
  int iterations = 0;
  double initial_cost = 0, final_cost = 0;  // half the sum of the robust squared residuals, in sigmas
};

[[nodiscard]] constexpr bool improved(const BundleSummary& s) noexcept {
  return s.status == Status::kOk || s.status == Status::kNotConverged;
}

}  // namespace sslam
