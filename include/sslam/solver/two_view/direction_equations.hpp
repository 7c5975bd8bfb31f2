// SPDX-License-Identifier: BSD-3-Clause
// Refinement of a direction of translation on the sphere over flows, and its covariance.
#pragma once

#include <cmath>

#include "sslam/solver/two_view/flow.hpp"

namespace sslam {

// Gauss-Newton on the sphere over the residuals whose square is squared_error. `noise` is what the noise
// within the rows adds to the normal matrix: without taking it out, the information promises too much at low
// parallax.
template <Scalar S>
struct DirectionEquations {
  Mat2<S> h = Mat2<S>::Zero();
  Mat2<S> noise = Mat2<S>::Zero();
  Vec2<S> g = Vec2<S>::Zero();

  void add(const Flow<S>& flow, const Vec3<S>& t_10, const Mat<S, 3, 2>& basis) noexcept {
    const Vec2<S> along = epipolar_direction(flow, t_10);
    const S scale = flow.weight / std::sqrt(flow.weight * along.squaredNorm() + S(0.5));
    const S r = flow.normal.dot(t_10) * scale;
    const S robust = std::abs(r) > S(1.5) ? S(1.5) / std::abs(r) : S(1);  // Huber
    const S k = scale * scale / flow.weight;
    const Mat<S, 2, 2> seen = basis.template topRows<2>() - flow.midpoint * basis.row(2);
    const Vec2<S> slope = seen.transpose() * along * k;
    const Vec2<S> j = basis.transpose() * flow.normal * scale - r * slope;
    h += robust * j * j.transpose();
    g += robust * r * j;
    noise += robust * (k * seen.transpose() * seen - slope * slope.transpose());
  }

  [[nodiscard]] bool step(const Mat<S, 3, 2>& basis, Vec3<S>& t_10) const noexcept {
    const S determinant = h.determinant();
    if (!(determinant > S(1e-9) * h.trace() * h.trace())) return false;
    Vec2<S> delta(h(0, 1) * g(1) - h(1, 1) * g(0), h(1, 0) * g(0) - h(0, 0) * g(1));
    delta /= determinant;
    constexpr S kLongest = S(0.3);  // rad
    if (!(delta.norm() < kLongest)) return false;
    t_10 = (t_10 + basis * delta).normalized();
    return true;
  }

  // False when some direction holds no more than noise does, to `chance`, the relative spread of its mean
  // square.
  [[nodiscard]] bool covariance(const Mat<S, 3, 2>& basis, S chance, Mat3<S>& out) const noexcept {
    const Mat2<S> sure = h - (1 + chance) * noise;
    if (!(sure(0, 0) > 0 && sure.determinant() > 0)) return false;
    const Mat2<S> information = h - noise;
    Mat2<S> inverse;
    inverse << information(1, 1), -information(0, 1), -information(1, 0), information(0, 0);
    out = basis * (inverse / information.determinant()) * basis.transpose();
    return out.allFinite();
  }
};

}  // namespace sslam
