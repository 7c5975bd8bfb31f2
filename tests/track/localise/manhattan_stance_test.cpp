// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/localise/manhattan_stance.hpp"

#include <tuple>

#include "support/catch.hpp"
#include "support/random_draws.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

// A frame of a world whose Manhattan frame stands `off` from where the map has it; its votes err by `sigma`.
TrackedFrame<double> frame_off(const Vec3<double>& off, double sigma, Random& random) {
  TrackedFrame<double> frame;
  frame.cam_from_world.rotation = SO3<double>::exp(0.3 * gaussian_vector<3>(random));
  const SO3<double> error = SO3<double>::exp(sigma * gaussian_vector<3>(random));
  frame.manhattan = {error * frame.cam_from_world.rotation * SO3<double>::exp(off),
                     sigma * sigma * Mat3<double>::Identity()};
  return frame;
}

Map<double> squared_map() {
  Map<double> map;
  map.world_from_manhattan.push_back(SO3<double>());
  map.keyframes.resize(1);
  map.keyframes[0].manhattan = {SO3<double>(), Mat3<double>::Identity()};
  return map;
}

}  // namespace

TEST_CASE("The Manhattan frame stands where the mean of the first frames has it, and what it told follows") {
  Random random(5);
  const Vec3<double> off(radians(1.5), 0, radians(-1.0));
  Map<double> map = squared_map();
  ManhattanStance<double> stance;
  stance.begin(true);
  for (int k = 0; k < 100; ++k) {
    // What the stage tells goes by the frame as the map has it now.
    TrackedFrame<double> frame = frame_off(off, radians(0.8), random);
    frame.manhattan->cam_from_world = frame.manhattan->cam_from_world * map.world_from_manhattan[0].inverse();
    stance.refine(map, frame);
  }
  CHECK((map.world_from_manhattan[0].log() - off).norm() < radians(0.3));
  CHECK((map.keyframes[0].manhattan->cam_from_world.log() + map.world_from_manhattan[0].log()).norm() < 1e-9);
}

TEST_CASE(
    "It stays where it is in a world that is gone on in, by weak rotations, and by those of other frames") {
  Random random(5);
  const Vec3<double> off(radians(1.5), 0, 0);
  for (const auto& [fresh, sigma, angle] :
       {std::tuple(false, 0.8, 1.0), std::tuple(true, 4.0, 1.0), std::tuple(true, 0.1, 20.0)}) {
    Map<double> map = squared_map();
    ManhattanStance<double> stance;
    stance.begin(fresh);
    for (int k = 0; k < 20; ++k) {
      TrackedFrame<double> frame = frame_off(angle * off, radians(sigma), random);
      stance.refine(map, frame);
    }
    CHECK(map.world_from_manhattan[0].log().norm() == 0);
  }
}
