// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/geometry/nearest_rotation.hpp"

#include <limits>

#include "sslam/core/random.hpp"
#include "sslam/testing/group_laws.hpp"
#include "support/catch.hpp"
#include "support/spoiled_input.hpp"
#include "support/test_scalars.hpp"

using namespace sslam;
using namespace sslam::testing;

TEMPLATE_TEST_CASE("a rotation is its own nearest", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Random random(1);
  for (const S angle : {S(0), S(1e-4), S(1), S(3.1)}) {
    const auto truth = SO3<S>::exp(tangent_of_angle<SO3<S>>(angle, random));
    SO3<S> found;
    REQUIRE(nearest_rotation<S>(S(2.5) * truth.matrix(), found) == Status::kOk);
    CHECK(angle_between(found, truth) < 20 * std::numeric_limits<S>::epsilon());
  }
}

TEST_CASE("no rotation nearby is nearer") {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    Mat3<double> m;
    for (int e = 0; e < 9; ++e) m(e / 3, e % 3) = random.uniform(-1.0, 1.0);
    SO3<double> found;
    REQUIRE(nearest_rotation(m, found) == Status::kOk);
    CHECK(std::abs(found.matrix().determinant() - 1) < 1e-12);
    const double distance = (found.matrix() - m).norm();
    for (int k = 0; k < 20; ++k) {
      const auto other = found.retract(tangent_of_angle<SO3<double>>(random.uniform(0.01, 3.0), random));
      CHECK((other.matrix() - m).norm() > distance - 1e-12);
    }
  }
}

TEMPLATE_TEST_CASE("two directions are enough and one is not", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const auto before = SO3<S>::exp({S(0.1), S(0.2), S(0.3)});
  auto rotation = before;
  Mat3<S> m = Mat3<S>::Zero();
  m.col(0) = before.matrix().col(0);
  CHECK(nearest_rotation<S>(m, rotation) == Status::kDegenerate);
  CHECK(nearest_rotation<S>(Mat3<S>::Zero(), rotation) == Status::kDegenerate);
  CHECK(angle_between(rotation, before) == 0);
  m.col(2) = before.matrix().col(2);
  rotation = {};
  CHECK(nearest_rotation<S>(m, rotation) == Status::kOk);
  CHECK(angle_between(rotation, before) < 20 * std::numeric_limits<S>::epsilon());
}

TEMPLATE_TEST_CASE("not finite is refused", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  Mat3<S> m = Mat3<S>::Identity();
  m(1, 2) = std::numeric_limits<S>::quiet_NaN();
  const auto before = SO3<S>::exp({S(0.1), S(0.2), S(0.3)});
  auto rotation = before;
  CHECK(nearest_rotation(m, rotation) == Status::kNotFinite);
  CHECK(angle_between(rotation, before) == 0);
}

TEMPLATE_TEST_CASE("whatever the matrix the answer is a rotation or left as it was", "", SSLAM_TEST_SCALARS) {
  using S = TestType;
  const auto before = SO3<S>::exp({S(0.1), S(0.2), S(0.3)});
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Random random(seed);
    INFO("seed " << seed);
    Mat3<S> m = before.inverse().matrix();
    spoil<S>(std::span(&m, 1), 1 + static_cast<int>(random.below(9)), random);
    auto rotation = before;
    const Mat3<S> R = usable(nearest_rotation(m, rotation)) ? rotation.matrix() : before.matrix();
    CHECK(R == rotation.matrix());
    CHECK((R * R.transpose() - Mat3<S>::Identity()).norm() < 20 * std::numeric_limits<S>::epsilon());
  }
}
