// SPDX-License-Identifier: BSD-3-Clause
// Products and factors of the small blocks of normal equations, as plain loops over fixed sizes: the compiler
// unrolls them, and no expression template has to be instantiated for each combination of shapes.
#pragma once

#include <cmath>

#include "sslam/core/types.hpp"

namespace sslam {

// H += w A^T B for A of R x M, B of R x N. Sums in locals: they cannot alias, so they stay in registers.
template <Scalar S, int R, int M, int N>
void add_product(const Mat<S, R, M>& a, const Mat<S, R, N>& b, S w, Mat<S, M, N>& H) noexcept {
  for (int n = 0; n < N; ++n) {
    Vec<S, M> sum = Vec<S, M>::Zero();
    for (int r = 0; r < R; ++r)
      for (int m = 0; m < M; ++m) sum[m] += a(r, m) * (w * b(r, n));
    for (int m = 0; m < M; ++m) H(m, n) += sum[m];
  }
}

// The lower half of H += w A^T A.
template <Scalar S, int R, int M>
void add_square(const Mat<S, R, M>& a, S w, Mat<S, M, M>& H) noexcept {
  for (int n = 0; n < M; ++n) {
    const Vec<S, R> wa = w * a.col(n);
    for (int m = n; m < M; ++m) {
      S sum = a(0, m) * wa[0];
      for (int r = 1; r < R; ++r) sum += a(r, m) * wa[r];
      H(m, n) += sum;
    }
  }
}

// g += w A^T e.
template <Scalar S, int R, int M>
void add_product(const Mat<S, R, M>& a, const Vec<S, R>& e, S w, Vec<S, M>& g) noexcept {
  for (int r = 0; r < R; ++r) {
    const S we = w * e[r];
    for (int m = 0; m < M; ++m) g[m] += we * a(r, m);
  }
}

// W L^T for a lower triangular L.
template <Scalar S, int M, int D>
[[nodiscard]] Mat<S, M, D> times_transposed_lower(const Mat<S, M, D>& W, const Mat<S, D, D>& L) noexcept {
  Mat<S, M, D> out = Mat<S, M, D>::Zero();
  for (int d = 0; d < D; ++d)
    for (int k = 0; k <= d; ++k)
      for (int m = 0; m < M; ++m) out(m, d) += W(m, k) * L(d, k);
  return out;
}

// The block of M x N at `corner` of a column-major matrix with the given stride, less A B^T.
template <Scalar S, int M, int N, int D>
void subtract_outer(const Mat<S, M, D>& a, const Mat<S, N, D>& b, S* corner, std::ptrdiff_t stride) noexcept {
  for (int n = 0; n < N; ++n) {
    Vec<S, M> sum = a.col(0) * b(n, 0);
    for (int d = 1; d < D; ++d) sum += a.col(d) * b(n, d);
    Eigen::Map<Vec<S, M>>{corner + n* stride} -= sum;
  }
}

}  // namespace sslam
