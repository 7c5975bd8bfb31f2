// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/localise/refinement.hpp"

#include "support/catch.hpp"

using namespace sslam;

namespace {

// `count` points two metres ahead of a camera in the world's origin, each seen where it is.
Correspondences<double> matches(int count) {
  Correspondences<double> m;
  for (int i = 0; i < count; ++i) {
    const Vec3<double> x(0.2 * i - 0.3, i % 2 ? 0.4 : -0.4, 2);
    m.points.push_back({x, 500 * x.head<2>() / x.z(), 1});
  }
  m.point_inliers.assign(m.points.size(), 1);
  return m;
}

template <int D>
PoseEstimate<double> judged(int count, bool turned, double sigma_degrees = 0.5) {
  const double sigma = radians(sigma_degrees);
  const RotationPrior<double> prior{{}, Mat3<double>::Identity() / (sigma * sigma)};
  PoseAcceptance<double> acceptance = LocalMapRefinement<double>().accepts(turned ? &prior : nullptr);
  if (D == 3) acceptance = DecoupledTranslation<double>().options.acceptance;
  Correspondences<double> m = matches(count);
  return judge<double, D>(m, {}, Mat<double, D, D>::Identity() * 1e6, acceptance);
}

}  // namespace

TEST_CASE("Fewer matches are enough where the Manhattan frame gives the rotation") {
  CHECK(judged<6>(10, false).ok());
  CHECK(judged<6>(10, false).scene_depth == 2);
  CHECK(judged<6>(9, false).reason == Reason::kTooFewMatches);
  CHECK(judged<3>(5, true).ok());
  CHECK(judged<6>(5, true).ok());
  CHECK(judged<6>(5, true, 1).reason == Reason::kTooFewMatches);  // known to a degree: six are left to solve
  CHECK(judged<3>(4, true).reason == Reason::kTooFewMatches);
}
