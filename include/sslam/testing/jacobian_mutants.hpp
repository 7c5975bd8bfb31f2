// SPDX-License-Identifier: BSD-3-Clause
// Wrong Jacobians of the kinds people write: a comparison that accepts one of them tests nothing.
#pragma once

#include <cmath>

#include "sslam/core/types.hpp"

namespace sslam::testing {

// Calls visit(name, mutant) for: each entry with its sign flipped, each entry 1 % too large, and each pair of
// rows or of columns swapped. Mutants that equal the original (a zero entry, two equal rows) are left out;
// `zero` is the size, relative to the largest entry, up to which an entry counts as zero.
template <Scalar S, int R, int C, class Visit>
void for_each_mutant(const Mat<S, R, C>& jacobian, Visit visit, S zero = S(1e-3)) {
  const S least = zero * jacobian.cwiseAbs().maxCoeff();
  const auto offer = [&](const char* name, const Mat<S, R, C>& mutant) {
    if ((mutant - jacobian).cwiseAbs().maxCoeff() > least / 100) visit(name, mutant);
  };
  for (int r = 0; r < R; ++r) {
    for (int c = 0; c < C; ++c) {
      if (!(std::abs(jacobian(r, c)) > least)) continue;
      Mat<S, R, C> mutant = jacobian;
      mutant(r, c) = -jacobian(r, c);
      offer("sign of an entry", mutant);
      mutant(r, c) = S(1.01) * jacobian(r, c);
      offer("1 % on an entry", mutant);
    }
  }
  for (int a = 0; a < C; ++a)
    for (int b = 0; b < a; ++b) {
      Mat<S, R, C> mutant = jacobian;
      mutant.col(a).swap(mutant.col(b));
      offer("swapped columns", mutant);
    }
  for (int a = 0; a < R; ++a)
    for (int b = 0; b < a; ++b) {
      Mat<S, R, C> mutant = jacobian;
      mutant.row(a).swap(mutant.row(b));
      offer("swapped rows", mutant);
    }
}

}  // namespace sslam::testing
