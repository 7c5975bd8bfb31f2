// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "sslam/geometry/plane3.hpp"
#include "sslam/testing/numeric_jacobian.hpp"
#include "support/catch.hpp"
#include "support/random_draws.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

Plane3<double> draw_plane(Random& random) {
  return {uniform_vector<double, 3>(random, -1.0, 1.0).normalized(), random.uniform(-2.0, 2.0)};
}

Vec4<double> stacked(const Plane3<double>& plane) {
  return (Vec4<double>() << plane.normal, plane.distance).finished();
}

}  // namespace

TEST_CASE("A point keeps its distance from a plane that moves with it, but for the scale") {
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const Plane3<double> plane = draw_plane(random);
    const Vec3<double> x = uniform_vector<double, 3>(random, -3.0, 3.0);
    const auto moved = Sim3<double>::exp(uniform_vector<double, 7>(random, -1.0, 1.0));
    CHECK(transform(moved, plane).offset(moved * x) == Approx(moved.scale * plane.offset(x)));
    const SE3<double> pose{moved.rotation, moved.translation};
    CHECK(transform(pose, plane).offset(pose * x) == Approx(plane.offset(x)));
  }
}

TEST_CASE("A ray meets a plane where it is, and says so when it runs along it") {
  const Plane3<double> wall{{0, 0, 1}, 4};
  double along = 0;
  REQUIRE(wall.meet({1, 0, 1}, {0.5, 0.5, 1.5}, along));
  CHECK(along == Approx(2));
  REQUIRE(wall.meet({1, 0, 5}, {0, 0, 1}, along));
  CHECK(along == Approx(-1));  // behind
  CHECK_FALSE(wall.meet({1, 0, 1}, {1, 0, 0.02}, along));
}

TEST_CASE("A plane stays one when it is moved, and its Jacobian is that of the move") {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const Plane3<double> plane = draw_plane(random);
    const Vec3<double> delta = uniform_vector<double, 3>(random, -0.5, 0.5);
    CHECK(plane.retract(delta).normal.norm() == Approx(1));
    CHECK(std::acos(plane.retract(delta).normal.dot(plane.normal)) == Approx(delta.head<2>().norm()));
    CHECK(worst_entry(plane.retract_jacobian(), numeric_jacobian(stacked, plane)).error < 1e-6);
  }
}
