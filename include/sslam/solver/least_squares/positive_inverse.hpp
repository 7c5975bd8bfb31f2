// SPDX-License-Identifier: BSD-3-Clause
// Inverses of small positive definite matrices.
#pragma once

#include <cmath>

#include "sslam/core/types.hpp"

namespace sslam {

// L^-1 of H = L L^T; only the lower half of H is read. False, with `out` untouched, where H is not positive
// definite or not finite.
template <Scalar S, int D>
[[nodiscard]] bool inverse_root(const Mat<S, D, D>& H, Mat<S, D, D>& out) noexcept {
  Mat<S, D, D> l = H;
  for (int c = 0; c < D; ++c) {
    for (int k = 0; k < c; ++k)
      for (int r = c; r < D; ++r) l(r, c) -= l(r, k) * l(c, k);
    if (!(l(c, c) > 0 && std::isfinite(l(c, c)))) return false;
    const S inverse = 1 / std::sqrt(l(c, c));
    l(c, c) = inverse;  // the diagonal is kept inverted
    for (int r = c + 1; r < D; ++r) l(r, c) *= inverse;
  }
  out.setZero();
  for (int c = 0; c < D; ++c) {
    out(c, c) = l(c, c);
    for (int r = c + 1; r < D; ++r) {
      S sum = 0;
      for (int k = c; k < r; ++k) sum += l(r, k) * out(k, c);
      out(r, c) = -sum * l(r, r);
    }
  }
  return true;
}

// H^-1 of a positive definite H; false, with `out` untouched, where H is not, or where its inverse is beyond
// the scalar's range: nobody takes an infinite covariance for one. Eigen's solve for a right side of several
// columns calls its blocked routines, which bring the heap, a guarded static and 15 kB of code even for 3
// x 3.
template <Scalar S, int D>
[[nodiscard]] bool inverse_of(const Mat<S, D, D>& H, Mat<S, D, D>& out) noexcept {
  Mat<S, D, D> root;
  if (!inverse_root<S, D>(H, root)) return false;
  const Mat<S, D, D> inverse = root.transpose() * root;
  if (!inverse.allFinite()) return false;
  out = inverse;
  return true;
}

}  // namespace sslam
