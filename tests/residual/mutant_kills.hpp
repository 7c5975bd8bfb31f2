// SPDX-License-Identifier: BSD-3-Clause
// Wrong Jacobians, which the comparison with the numeric one must tell from the right one.
#pragma once

#include "residual_scene.hpp"
#include "sslam/testing/jacobian_mutants.hpp"
#include "sslam/testing/numeric_jacobian.hpp"
#include "support/catch.hpp"

namespace sslam::testing {

class MutantKills {
 public:
  void operator()(const char* name, const auto& mutant, const auto& truth) {
    CAPTURE(name);
    CHECK(worst_entry(mutant, truth).error > kDiffer);
    ++count_;
  }

  [[nodiscard]] int count() const noexcept { return count_; }

 private:
  int count_ = 0;
};

}  // namespace sslam::testing
