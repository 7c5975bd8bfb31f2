// SPDX-License-Identifier: BSD-3-Clause
// A plane through places of known uncertainty, by robust least squares, with its covariance.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "sslam/geometry/plane3.hpp"
#include "sslam/solver/least_squares/positive_inverse.hpp"

namespace sslam::dense {

// A place in the world that may lie on a plane.
struct PlaneSample {
  Vec3<double> place;
  double sigma = 0;  // standard deviation along the plane's normal, units of the map; > 0
};

struct PlaneFit {
  Plane3<double> plane;
  Mat3<double> covariance = Mat3<double>::Zero();  // of Plane3's tangent: rad, rad, units of the map
  bool determined = false;
};

// Minimises  sum rho((n . x - d)^2 / s^2) + |turn|^2 / tilt_sigma^2  over the plane, from `start`, with
// Cauchy's rho of width 2 (Gauss-Newton with reweighting). `turn` is that of the normal from its start;
// tilt_sigma: radians, 0 holds the normal, infinity frees it. The covariance is the inverse of the normal
// matrix, times chi^2 per degree of freedom where that is above 1. Not determined where the places do not
// say, as when they lie on one line and the normal is free.
[[nodiscard]] inline PlaneFit fit_plane(std::span<const PlaneSample> samples, const Plane3<double>& start,
                                        double tilt_sigma) {
  constexpr int kSteps = 8;
  constexpr double kWidth2 = 4, kTiny = 1e-9;
  PlaneFit fit{start};
  if (samples.empty()) return fit;
  // About the middle of the samples: there, normal and distance are all but independent.
  Vec3<double> middle = Vec3<double>::Zero();
  for (const PlaneSample& s : samples) middle += s.place / static_cast<double>(samples.size());
  Plane3<double> plane{start.normal, start.offset(middle) * -1};  // of x - middle
  const double hold = std::isinf(tilt_sigma) ? 0 : 1 / std::max(tilt_sigma * tilt_sigma, kTiny * kTiny);
  Mat3<double> inverse;
  double chi2 = 0;
  for (int step = 0; step < kSteps; ++step) {
    const Mat<double, 3, 2> basis = tangent_basis(plane.normal);
    const Vec2<double> turn = TangentChart<double>(plane.normal).to_plane(start.normal);
    Mat3<double> h = Mat3<double>::Zero();
    h.topLeftCorner<2, 2>() = hold * Mat2<double>::Identity();
    Vec3<double> g(-hold * turn.x(), -hold * turn.y(), 0);
    chi2 = 0;
    for (const PlaneSample& s : samples) {
      const Vec3<double> x = s.place - middle;
      const double r = plane.offset(x) / s.sigma;
      const double w = 1 / (1 + r * r / kWidth2);
      Vec3<double> j;
      j << basis.transpose() * x, -1;
      j /= s.sigma;
      h += w * j * j.transpose();
      g += w * r * j;
      chi2 += w * r * r;
    }
    if (!inverse_of<double, 3>(h, inverse)) return fit;
    const Vec3<double> delta = -(inverse * g);
    if (!delta.allFinite()) return fit;
    plane = plane.retract(delta);
    if (delta.norm() < kTiny) break;
  }
  fit.plane = {plane.normal, plane.distance + plane.normal.dot(middle)};
  // From x - middle to x: the distance moves by the turn times the middle.
  Mat3<double> shift = Mat3<double>::Identity();
  shift.bottomLeftCorner<1, 2>() = (tangent_basis(plane.normal).transpose() * middle).transpose();
  const double spread = samples.size() > 3 ? chi2 / static_cast<double>(samples.size() - 3) : 1;
  fit.covariance = std::max(1.0, spread) * shift * inverse * shift.transpose();
  fit.determined = fit.plane.normal.allFinite() && std::isfinite(fit.plane.distance);
  return fit;
}

}  // namespace sslam::dense
