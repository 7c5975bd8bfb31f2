// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/matching/frame_turn.hpp"

#include "support/catch.hpp"
#include "track/simulation.hpp"

namespace frame_turn_test {

using namespace sslam;
using namespace sslam::testing;

// Looks to the left and then 25 degrees further to the right, from a place 3 cm beside.
std::vector<SE3<double>> two_views() {
  return {look({0, 0, -2}, radians(-10.0)), look({0.03, 0, -2}, radians(15.0), radians(4.0))};
}

}  // namespace frame_turn_test

TEST_CASE("The turn between two frames is told by their features, wherever these were before") {
  using namespace frame_turn_test;
  Simulation simulation(two_views());
  const Frame<double> from = simulation.frame(0), to = simulation.frame(1);
  FrameTurn<double> turn;
  const std::optional<SO3<double>> found = turn.between(from, to);
  REQUIRE(found.has_value());
  const SO3<double> truth = simulation.truth(1).rotation * simulation.truth(0).rotation.inverse();
  CHECK(angle_between(*found, truth) < radians(1.0));
  CHECK(angle_between(*found, SO3<double>()) > radians(20.0));
}

TEST_CASE("Frames with too little in common tell no turn") {
  using namespace frame_turn_test;
  Simulation simulation({look({0, 0, -2}, 0), look({0, 0, -2}, radians(90.0))});
  FrameTurn<double> turn;
  const Frame<double> from = simulation.frame(0);
  CHECK_FALSE(turn.between(from, simulation.frame(1)).has_value());
  CHECK_FALSE(turn.between(from, simulation.dark_frame(0)).has_value());
}

TEST_CASE("A camera that turns where it stands keeps its place") {
  using namespace frame_turn_test;
  const SE3<double> before = look({0.3, -0.1, 1}, radians(20.0));
  const SO3<double> by = SO3<double>::exp({0.1, -0.4, 0.2});
  const SE3<double> after = turned(by, before);
  CHECK((after.inverse().translation - before.inverse().translation).norm() < 1e-12);
  CHECK(angle_between(after.rotation * before.rotation.inverse(), by) < 1e-9);
}
