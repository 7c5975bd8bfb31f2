// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/map/map_adjustment.hpp"
#include "support/catch.hpp"
#include "support/map_errors.hpp"

using namespace sslam;
using namespace sslam::testing;

TEST_CASE("Adjustment in single precision comes to the same level") {
  MapScene scene({.points = 2400, .lines = 400}, sweep(12, 0.25));
  Map<float> map = to_float(scene.make_map());
  perturb(scene, map, 5, radians(0.3), 0.02);
  MapAdjustment<float> adjustment;
  REQUIRE(improved(adjustment.optimise(map, 11)));
  const MapErrors after = measure(scene, map);
  REQUIRE(after.rotation < 0.1);
  REQUIRE(after.centre < 0.01);
}
