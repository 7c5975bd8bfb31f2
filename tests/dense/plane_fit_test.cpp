// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/dense/plane_fit.hpp"

#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/dense/triangulate.hpp"
#include "support/catch.hpp"
#include "support/random_draws.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace dense_fit_test {

// Near normal . x = distance, with errors up to `noise` along the normal, uniform: sigma noise / sqrt(3).
std::vector<dense::PlaneSample> samples_on(const Plane3<double>& plane, int count, double noise,
                                           Random& random) {
  const Mat<double, 3, 2> basis = tangent_basis(plane.normal);
  std::vector<dense::PlaneSample> samples;
  for (int i = 0; i < count; ++i) {
    const Vec2<double> u = uniform_vector<double, 2>(random, 0.5, 3);
    const Vec3<double> on = plane.distance * plane.normal + basis * u;
    samples.push_back({on + random.uniform(-noise, noise) * plane.normal, noise / std::sqrt(3.0)});
  }
  return samples;
}

}  // namespace dense_fit_test

TEST_CASE("a plane is found through noise and strangers, and its covariance is that of many tries") {
  const Plane3<double> truth{Vec3<double>(0.3, -0.8, 0.52).normalized(), 1.7};
  constexpr int kTries = 300;
  Random random(3);
  Vec3<double> squares = Vec3<double>::Zero(), said = Vec3<double>::Zero();
  for (int t = 0; t < kTries; ++t) {
    auto samples = dense_fit_test::samples_on(truth, 40, 0.02, random);
    const dense::PlaneFit fit = dense::fit_plane(samples, truth.retract({0.05, -0.03, 0.04}),
                                                 std::numeric_limits<double>::infinity());
    REQUIRE(fit.determined);
    Vec3<double> error;
    error << TangentChart<double>(fit.plane.normal).to_plane(truth.normal),
        truth.distance - fit.plane.distance;
    squares += error.cwiseAbs2() / kTries;
    said += fit.covariance.diagonal() / kTries;
    if (t > 0) continue;
    samples.push_back({truth.normal * 3, 0.01});
    const dense::PlaneFit again = dense::fit_plane(samples, truth, std::numeric_limits<double>::infinity());
    CHECK(std::abs(again.plane.distance - fit.plane.distance) < 0.01);
  }
  for (int k = 0; k < 3; ++k) CHECK(said[k] == Approx(squares[k]).epsilon(0.35));
}

TEST_CASE("places on a line leave a free plane open, and one that is held by its axis not") {
  std::vector<dense::PlaneSample> samples;
  for (int i = 0; i < 10; ++i) samples.push_back({Vec3<double>(0.2 * i, 1, 0), 0.01});
  const Plane3<double> start{Vec3<double>::UnitY(), 0.9};
  CHECK_FALSE(dense::fit_plane(samples, start, std::numeric_limits<double>::infinity()).determined);
  const dense::PlaneFit held = dense::fit_plane(samples, start, radians(0.3));
  CHECK(held.determined);
  CHECK(held.plane.distance == Approx(1).margin(1e-6));
  CHECK_FALSE(dense::fit_plane({}, start, 0).determined);
}

TEST_CASE("cells with a hole become a ring and a hole, and triangles that leave it open") {
  const auto solid = [](int c, int r) {
    return c >= 0 && r >= 0 && c < 6 && r < 5 && !(c >= 2 && c < 4 && r >= 1 && r < 3);
  };
  const std::vector<dense::Polygon> polygons = dense::nest(dense::trace_cells(6, 5, solid));
  REQUIRE(polygons.size() == 1);
  REQUIRE(polygons[0].holes.size() == 1);
  dense::Polygon thin{dense::simplify(polygons[0].outer, 0.1), {dense::simplify(polygons[0].holes[0], 0.1)}};
  CHECK(thin.outer.size() == 4);
  CHECK(thin.holes[0].size() == 4);
  CHECK(dense::twice_area(thin.outer) == 60);
  CHECK(dense::twice_area(thin.holes[0]) == -8);
  const dense::Triangulator cut(thin);
  double area = 0;
  for (const dense::Triangle& t : cut.triangles) {
    const dense::Ring ring{cut.corners[t[0]], cut.corners[t[1]], cut.corners[t[2]]};
    CHECK(dense::twice_area(ring) > 0);
    area += dense::twice_area(ring) / 2;
    CHECK_FALSE(dense::inside(ring, {3, 2}));
  }
  CHECK(area == Approx(26));
}

TEST_CASE("cells that touch in a corner alone are two polygons") {
  const auto solid = [](int c, int r) { return (c == 0 && r == 0) || (c == 1 && r == 1); };
  CHECK(dense::nest(dense::trace_cells(2, 2, solid)).size() == 2);
}
