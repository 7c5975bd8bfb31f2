// SPDX-License-Identifier: BSD-3-Clause
// Matches between two views of a random scene, with noise and mismatches, for the tests of two-view geometry.
#pragma once

#include <cmath>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/geometry/so3.hpp"
#include "sslam/solver/two_view/epipolar.hpp"
#include "support/random_draws.hpp"

namespace sslam {

using testing::gaussian;
using testing::gaussian_vector;

inline Vec3<double> random_direction(Random& random) {
  return gaussian_vector<3>(random).normalized();
}

struct TwoViewOptions {
  int matches = 500;
  double mismatches = 0;  // share
  double noise = 1;       // pixels at a focal length of 500
  double baseline = 0.3;  // metres, at depths from 2 to 6
  double turn = 5;        // degrees
  enum Scene { kDeep, kFlat, kInfinite, kCollinear } scene = kDeep;
};

struct TwoViews {
  static constexpr double kFocal = 500;
  SO3<double> R_10;
  Vec3<double> t_10;  // unit
  std::vector<BearingMatch<double>> matches;
  std::vector<bool> correct;

  template <Scalar S>
  [[nodiscard]] std::vector<BearingMatch<S>> as() const {
    std::vector<BearingMatch<S>> out;
    for (const auto& m : matches)
      out.push_back({m.ray0.template cast<S>(), m.ray1.template cast<S>(), static_cast<S>(m.sigma)});
    return out;
  }
};

inline TwoViews make_two_views(const TwoViewOptions& o, std::uint64_t seed) {
  Random random(seed);
  const auto spread = [&](double limit) { return random.uniform(-limit, limit); };
  TwoViews views;
  views.R_10 = SO3<double>::exp(radians(o.turn) * random_direction(random));
  views.t_10 = Vec3<double>{spread(1), spread(0.5), spread(0.7)}.normalized();
  const Vec3<double> plane{spread(0.5), spread(0.5), 1};
  if (o.scene == TwoViewOptions::kCollinear) views.t_10 = views.R_10 * Vec3<double>(1, 0.2, 0).normalized();
  while (static_cast<int>(views.matches.size()) < o.matches) {
    Vec3<double> ray0{spread(0.6), spread(0.45), 1};
    double depth = random.uniform(2.0, 6.0);
    if (o.scene == TwoViewOptions::kCollinear) ray0.y() = 0.2 * ray0.x();
    if (o.scene == TwoViewOptions::kFlat) depth = 4 / plane.dot(ray0);
    if (o.scene == TwoViewOptions::kInfinite) depth = 1e7;
    const Vec3<double> x1 = views.R_10 * (depth * ray0) + o.baseline * views.t_10;
    if (x1.z() < 0.3) continue;
    Vec3<double> ray1 = x1 / x1.z();
    if (std::abs(ray1.x()) > 0.64 || std::abs(ray1.y()) > 0.48) continue;
    const bool correct = random.uniform(0.0, 1.0) >= o.mismatches;
    if (!correct) ray1 = {spread(0.64), spread(0.48), 1};
    for (int i = 0; i < 2; ++i) {
      ray0[i] += o.noise / TwoViews::kFocal * gaussian(random);
      ray1[i] += o.noise / TwoViews::kFocal * gaussian(random);
    }
    views.matches.push_back({ray0, ray1, 1 / TwoViews::kFocal});
    views.correct.push_back(correct);
  }
  return views;
}

// Squared error of a unit direction in units of a predicted rank-2 covariance; 2 on average when that is
// honest.
template <Scalar S>
double direction_chi2(const Vec3<S>& found, const Mat3<S>& covariance, const Vec3<double>& truth) {
  const Vec3<double> error = found.template cast<double>() - truth;
  const Mat3<double> c = covariance.template cast<double>() + truth * truth.transpose();
  return error.dot(c.inverse() * error);
}

inline double angle_deg(const Vec3<double>& a, const Vec3<double>& b) {
  return degrees(std::atan2(a.cross(b).norm(), a.dot(b)));
}

}  // namespace sslam
