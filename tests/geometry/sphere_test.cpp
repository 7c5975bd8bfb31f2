// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/geometry/sphere.hpp"

#include <limits>

#include "sslam/core/random.hpp"
#include "support/catch.hpp"
#include "support/test_scalars.hpp"

using namespace sslam;

namespace {

template <class S>
Vec3<S> random_unit(Random& random) {
  Vec3<S> v;
  do {
    v = {random.uniform(S(-1), S(1)), random.uniform(S(-1), S(1)), random.uniform(S(-1), S(1))};
  } while (v.norm() > 1 || v.norm() < S(0.1));
  return v.normalized();
}

}  // namespace

TEMPLATE_TEST_CASE("tangent basis is right-handed at every axis", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  constexpr S kTolerance = 10 * std::numeric_limits<S>::epsilon();
  Random random(1);
  for (int i = 0; i < 206; ++i) {
    Vec3<S> a = random_unit<S>(random);
    if (i < 6) a = (i % 2 == 0 ? S(1) : S(-1)) * Vec3<S>::Unit(i / 2);
    const auto b = tangent_basis(a);
    CHECK((b.transpose() * b - Mat2<S>::Identity()).norm() < kTolerance);
    CHECK((b.col(0).cross(b.col(1)) - a).norm() < kTolerance);
  }
}

TEMPLATE_TEST_CASE("tangent chart keeps the angle from its axis and comes back", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  constexpr S kTolerance = 20 * std::numeric_limits<S>::epsilon();
  Random random(2);
  for (const S angle : {S(0), S(1e-7), S(1e-3), S(0.17), S(1.5), S(3)}) {
    for (int i = 0; i < 20; ++i) {
      const TangentChart<S> chart(random_unit<S>(random));
      const S heading = random.uniform(S(0), S(6.28));
      const Vec2<S> m(angle * std::cos(heading), angle * std::sin(heading));
      const Vec3<S> on_sphere = chart.to_sphere(m);
      CHECK(std::abs(on_sphere.norm() - 1) < kTolerance);
      CHECK(std::abs(std::atan2(on_sphere.cross(chart.axis).norm(), on_sphere.dot(chart.axis)) - angle) <
            kTolerance);
      // Near the far pole a small way on the sphere is a long one on the plane.
      CHECK((chart.to_plane(on_sphere) - m).norm() < 20 * kTolerance);
    }
  }
}

TEST_CASE("the axis itself is the origin of its chart") {
  const TangentChart<double> chart(Vec3<double>(0, 0.6, -0.8));
  CHECK(chart.to_plane(chart.axis).norm() < 1e-15);
  CHECK((chart.to_sphere({0, 0}) - chart.axis).norm() < 1e-15);
  CHECK(chart.to_plane(-chart.axis).allFinite());
}
