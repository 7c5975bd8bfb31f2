// SPDX-License-Identifier: BSD-3-Clause
// Derivatives by differences along a state's own retraction, and their comparison with analytic ones, entry
// by entry.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "sslam/geometry/manifold.hpp"

namespace sslam::testing {

// d f / d tangent at x: column i is the slope of f(x.retract(h e_i)) at h = 0, by central differences of
// fourth order (error about step^4 times the fifth derivative). f returns a fixed-size vector; differentiate
// in double.
template <class F, Manifold X, class S = ScalarOf<X>>
[[nodiscard]] auto numeric_jacobian(const F& f, const X& x, S step = S(1e-3)) {
  using Value = std::remove_cvref_t<decltype(f(x).eval())>;
  const auto at = [&](int i, S h) -> Value {
    return f(x.retract(Vec<S, X::kDof>(h * Vec<S, X::kDof>::Unit(i))));
  };
  Mat<S, Value::RowsAtCompileTime, X::kDof> j;
  for (int i = 0; i < X::kDof; ++i) {
    const Value near = at(i, step) - at(i, -step);
    const Value far = at(i, 2 * step) - at(i, -2 * step);
    j.col(i) = (8 * near - far) / (12 * step);
  }
  return j;
}

struct WorstEntry {
  int row = 0, col = 0;
  double error = 0;  // infinite when an entry is not finite
};

// The entry that differs most, relative to itself. Entries below `floor` times the largest of the expected
// matrix are measured against that instead, since a difference quotient cannot tell them from zero. A norm
// over the whole matrix would let a wrong entry hide behind a large one.
template <class A, class B>
[[nodiscard]] WorstEntry worst_entry(const Eigen::MatrixBase<A>& analytic,
                                     const Eigen::MatrixBase<B>& expected, double floor = 1e-3) {
  EIGEN_STATIC_ASSERT_SAME_MATRIX_SIZE(A, B)
  const double least = std::max(floor * static_cast<double>(expected.cwiseAbs().maxCoeff()), 1e-12);
  WorstEntry worst;
  for (int r = 0; r < expected.rows(); ++r) {
    for (int c = 0; c < expected.cols(); ++c) {
      const auto want = static_cast<double>(expected(r, c));
      double error = std::abs(static_cast<double>(analytic(r, c)) - want) / std::max(std::abs(want), least);
      if (!std::isfinite(error)) error = std::numeric_limits<double>::infinity();
      if (error > worst.error) worst = {r, c, error};
    }
  }
  return worst;
}

}  // namespace sslam::testing
