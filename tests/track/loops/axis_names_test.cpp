// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/loops/axis_names.hpp"

#include <numbers>

#include "support/catch.hpp"

namespace {

using namespace sslam;

constexpr double kRight = std::numbers::pi / 2;

SO3<double> turn(double x, double y, double z) {
  return SO3<double>::exp({x, y, z});
}

}  // namespace

TEST_CASE("Two worlds that show the same Manhattan frame stand at right angles, however it was named") {
  std::vector<SO3<double>> into{SO3<double>()};
  const std::vector<SO3<double>> other{SO3<double>()};
  // The other world's z points along this one's x, and the rotation was measured half a degree off.
  const auto names =
      name_axes(into, other, turn(0, kRight, 0) * turn(radians(0.3), radians(0.4), 0), radians(15.0));
  CHECK(angle_between(names.into_from_other, turn(0, kRight, 0)) < 1e-12);
  CHECK(into.size() == 1);
  CHECK(names(0) == 2);
  CHECK(names(1) == 1);
  CHECK(names(2) == 0);
  CHECK(names(kNone) == kNone);
}

TEST_CASE("A Manhattan frame that only the other world knows joins those of this one") {
  const SO3<double> wing = turn(0, radians(30.0), 0);
  std::vector<SO3<double>> into{SO3<double>()};
  const std::vector<SO3<double>> other{wing, SO3<double>()};  // y in common
  const auto names = name_axes(into, other, turn(0, radians(1.0), 0), radians(15.0));
  CHECK(angle_between(names.into_from_other, SO3<double>()) < 1e-12);  // by the frame in common
  REQUIRE(into.size() == 2);
  CHECK(angle_between(into[1], wing) < 1e-12);
  CHECK(names(0) == 3);
  CHECK(names(1) == 1);  // the shared axis has one number
  CHECK(names(2) == 5);
  CHECK(names(3) == 0);
  CHECK(names(5) == 2);
}

TEST_CASE("Without a Manhattan frame in common the rotation is as it was measured") {
  const SO3<double> measured = turn(0.1, 0.2, 0.3);
  std::vector<SO3<double>> into;
  const auto names = name_axes(into, {turn(0.5, 0, 0)}, measured, radians(15.0));
  CHECK(angle_between(names.into_from_other, measured) == 0);
  REQUIRE(into.size() == 1);
  CHECK(angle_between(into[0], measured * turn(0.5, 0, 0)) < 1e-12);
  CHECK(names(1) == 1);
}
