// SPDX-License-Identifier: BSD-3-Clause
// A match of two bearings and its epipolar error in standard deviations (Sampson), with derivatives.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "sslam/core/types.hpp"

namespace sslam {

// One scene point seen from camera 0 and camera 1.
template <Scalar S>
struct BearingMatch {
  Vec3<S> ray0, ray1;  // normalised, undistorted coordinates (x, y, 1)
  S sigma =
      S(1) / 500;  // standard deviation of each coordinate: pixels over focal length (1 px at f = 500 px)
};

template <Scalar S>
[[nodiscard]] bool is_finite(const BearingMatch<S>& match) noexcept {
  return std::isfinite(match.ray0.sum() + match.ray1.sum() + match.sigma) && match.sigma > 0;
}

template <Scalar S>
[[nodiscard]] bool all_finite(std::span<const BearingMatch<S>> matches) noexcept {
  return std::all_of(matches.begin(), matches.end(), [](const auto& match) { return is_finite(match); });
}

// Residual and derivatives with respect to t_10 (as a free vector) and to a left perturbation of R_10.
template <Scalar S>
struct EpipolarRow {
  S residual;  // in standard deviations
  Vec3<S> wrt_rotation;
  Vec3<S> wrt_translation;
  Vec3<S> slope;  // C t / d, with C the covariance (in sigma^2) of d residual / d t and d = t . C t
};

// r = e / (sigma sqrt(d)): e = t . (R x0 x x1) and d the sum of its squared derivatives with respect to the
// four observed coordinates (Sampson 1982; Hartley and Zisserman, eq. 11.9, with E = [t] R). One sigma^2
// |t|^2, the second order of the noise, keeps d positive at the epipoles. t_10 has unit length.
template <Scalar S>
[[nodiscard]] EpipolarRow<S> epipolar_row(const Mat3<S>& R_10, const Vec3<S>& t_10,
                                          const BearingMatch<S>& match) noexcept {
  const Vec3<S> x0 = R_10 * match.ray0;
  const Vec3<S>& x1 = match.ray1;
  const Vec3<S> normal = x0.cross(x1);
  const Vec3<S> plane0 = x1.cross(t_10);  // d e / d x0
  const Vec3<S> plane1 = t_10.cross(x0);  // d e / d x1
  // The third coordinate of a ray is exact: it carries no noise.
  const Vec3<S> axis0 = R_10.col(2);
  const Vec3<S> seen0 = plane0 - axis0 * axis0.dot(plane0);
  const Vec3<S> seen1(plane1.x(), plane1.y(), 0);
  const S variance = match.sigma * match.sigma;
  const S d = seen0.squaredNorm() + seen1.squaredNorm() + variance * t_10.squaredNorm();
  const S scale = 1 / (match.sigma * std::sqrt(d));
  const S e = t_10.dot(normal);

  EpipolarRow<S> row;
  row.residual = e * scale;
  row.slope = (seen0.cross(x1) + x0.cross(seen1) + variance * t_10) / d;
  row.wrt_translation = scale * normal - row.residual * row.slope;
  const Vec3<S> half_d = x0.cross(seen1.cross(t_10)) + seen0.cross(plane0);  // half the gradient of d
  row.wrt_rotation = scale * x0.cross(plane0) - (row.residual / d) * half_d;
  return row;
}

template <Scalar S>
[[nodiscard]] S epipolar_residual(const Mat3<S>& R_10, const Vec3<S>& t_10,
                                  const BearingMatch<S>& match) noexcept {
  const Vec3<S> x0 = R_10 * match.ray0;
  const Vec3<S> plane0 = match.ray1.cross(t_10);
  const Vec3<S> plane1 = t_10.cross(x0);
  const S along0 = R_10.col(2).dot(plane0);
  const S d = plane0.squaredNorm() - along0 * along0 + plane1.template head<2>().squaredNorm() +
              match.sigma * match.sigma * t_10.squaredNorm();
  return x0.dot(plane0) / (match.sigma * std::sqrt(d));
}

}  // namespace sslam
