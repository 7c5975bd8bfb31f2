// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/map/vertical.hpp"

#include <cmath>
#include <span>
#include <vector>

#include "support/catch.hpp"

namespace vertical_test {

using namespace sslam;

// Cameras that lean to the side by so many degrees; y is down.
Map<double> leaning(const std::vector<double>& degrees) {
  Map<double> map;
  for (const double lean : degrees) {
    Keyframe<double> kf;
    kf.cam_from_world.rotation = SO3<double>::exp({0, 0, radians(lean)});
    map.add_keyframe(kf);
  }
  return map;
}

Vec3<double> turned(double degrees) {
  return SO3<double>::exp({0, 0, radians(-degrees)}) * Vec3<double>::UnitY();
}

}  // namespace vertical_test

TEST_CASE("Down is the mean of the cameras' own, without those that were removed") {
  using namespace vertical_test;
  CHECK(mean_down(Map<double>()).isZero());
  Map<double> map = leaning({-20, 20});
  CHECK((mean_down(map) - Vec3<double>(0, std::cos(radians(20.0)), 0)).norm() < 1e-12);
  map = leaning({10, 10, 170});
  map.erase_keyframe(2, 0);
  CHECK((mean_down(map) - turned(10)).norm() < 1e-12);
  CHECK(mean_down(leaning({0, 180})).norm() < 1e-12);
}

TEST_CASE("The vertical axis is the nearest one that leans no more than it may, and points down") {
  using namespace vertical_test;
  const std::vector<SO3<double>> frames{SO3<double>::exp({0, 0, radians(-25.0)}),
                                        SO3<double>::exp({0, 0, radians(-170.0)})};
  const std::span<const SO3<double>> first(frames.data(), 1), both = frames;
  const Vec3<double> down = Vec3<double>::UnitY();
  CHECK((vertical_axis<double>(first, down, radians(30.0)) - turned(25)).norm() < 1e-12);
  CHECK(vertical_axis<double>(first, down, radians(20.0)).isZero());
  // The second frame stands upside down, and nearer.
  CHECK((vertical_axis<double>(both, down, radians(30.0)) - turned(-10)).norm() < 1e-12);
}

TEST_CASE("Up is the axis of the first Manhattan frame, else the cameras', else that of the first camera") {
  using namespace vertical_test;
  CHECK((up_direction(Map<double>()) + Vec3<double>::UnitY()).norm() < 1e-15);
  Map<double> map = leaning({10, 10});
  CHECK((up_direction(map) + turned(10)).norm() < 1e-12);
  map.world_from_manhattan.push_back(SO3<double>::exp({0, 0, radians(-12.0)}));
  map.world_from_manhattan.push_back(SO3<double>::exp({0, 0, radians(-10.0)}));
  CHECK((up_direction(map) + turned(12)).norm() < 1e-12);
  map.world_from_manhattan[0] = SO3<double>::exp({0, 0, radians(-45.0)});  // no axis of it is near
  CHECK((up_direction(map) + turned(10)).norm() < 1e-12);
}
