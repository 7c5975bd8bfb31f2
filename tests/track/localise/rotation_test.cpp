// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/localise/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/catch.hpp"
#include "support/random_draws.hpp"
#include "track/simulation.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

const std::vector<SO3<double>> kWorldAxes{SO3<double>()};

// Two walls and the floor as a network sees them: little scatter, but each plane is off by its own
// `bias_deg`.
void add_biased_planes(NormalField& field, const SO3<double>& cam_from_world, double bias_deg,
                       Random& random) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3<double> bias = radians(bias_deg) * gaussian_vector<3>(random).normalized();
    const Vec3<double> plane = (SO3<double>::exp(bias) * cam_from_world).matrix().col(axis);
    for (int i = 0; i < 800; ++i) {
      const Vec3<double> scatter = radians(1.0) * gaussian_vector<3>(random);
      const Vec3<float> n = (plane + scatter).normalized().cast<float>();
      field.push_back(n.x(), n.y(), n.z(), 1);
    }
  }
}

Frame<double> frame_with_normals(Simulation& simulation, double bias_deg, double plane_sigma_deg,
                                 Random& random) {
  Frame<double> frame = simulation.frame(0);
  add_biased_planes(frame.normals, simulation.truth(0).rotation, bias_deg, random);
  frame.normals.plane_sigma = static_cast<float>(radians(plane_sigma_deg));
  return frame;
}

double standard_deviation(const RotationObservation<double>& observation) {
  return std::sqrt(observation.covariance.trace() / 3);
}

}  // namespace

TEST_CASE("What the normals of a plane get wrong together is not averaged away") {
  Simulation simulation(walk(1));
  Random random(3);
  for (int trial = 0; trial < 10; ++trial) {
    Frame<double> frame = frame_with_normals(simulation, 5, 5, random);
    frame.lines.clear();
    ManhattanRotation<double> stage;
    const auto answer = stage.rotate(frame, simulation.truth(0).rotation, {kWorldAxes, true});
    CHECK(answer.axes_seen >= 2);
    REQUIRE(answer.seen);
    CHECK_FALSE(answer.trusted());
    const RotationObservation<double>& seen = answer.seen->rotation;
    CHECK(standard_deviation(seen) > radians(2.0));
    CHECK(angle_between(seen.cam_from_world, simulation.truth(0).rotation) < 4 * standard_deviation(seen));
  }
}

TEST_CASE("Lines decide where normals are known to be off") {
  Simulation simulation(walk(1));
  Random random(4);
  double told = 0, untold = 0;
  for (int trial = 0; trial < 10; ++trial) {
    for (double* sum : {&told, &untold}) {
      const Frame<double> frame = frame_with_normals(simulation, 5, sum == &told ? 5 : 0, random);
      ManhattanRotation<double> stage;
      const auto answer = stage.rotate(frame, simulation.truth(0).rotation, {kWorldAxes, true});
      REQUIRE(answer.trusted());
      *sum += angle_between(answer.seen->rotation.cam_from_world, simulation.truth(0).rotation);
    }
  }
  CHECK(told / 10 < radians(1.0));
  CHECK(told < untold);
}

TEST_CASE("A second Manhattan frame gives the same world's rotation, and is known again") {
  const SO3<double> wing = SO3<double>::exp(Vec3<double>(0, radians(35.0), 0));
  ManhattanRotation<double> stage;
  std::vector<SO3<double>> known = kWorldAxes;
  Random random(5);
  // What the camera sees while it turns: the first frame, the wing, the first, the wing.
  int step = 0;
  for (const bool in_wing : {false, true, false, true})
    for (int i = 0; i < 8; ++i, ++step) {
      const SO3<double> cam_from_world = SO3<double>::exp(Vec3<double>(0.1, 0.02 * step, -0.05));
      Frame<double> frame;
      frame.pinhole = Pinhole<double>{500, 500, 320, 240};
      add_biased_planes(frame.normals, in_wing ? cam_from_world * wing : cam_from_world, 0, random);
      const auto answer = stage.rotate(frame, cam_from_world, {known, true});
      const bool new_to_it = step >= 8 && step < 10;  // believed at the third sighting
      REQUIRE(answer.trusted() == !new_to_it);
      CHECK(answer.discovered.has_value() == (step == 10));
      if (answer.discovered) known.push_back(*answer.discovered);
      if (new_to_it) continue;
      CHECK(answer.seen->manhattan_frame == (in_wing ? 1U : 0U));
      CHECK(angle_between(answer.seen->rotation.cam_from_world, cam_from_world) < radians(0.5));
    }
  CHECK(angle_between(known.back(), wing) < radians(0.5));
}

TEST_CASE("Before there is a map the first Manhattan frame becomes the axes of the world") {
  Random random(6);
  const SO3<double> cam_from_manhattan = SO3<double>::exp(Vec3<double>(0.1, 0.3, -0.05));
  Frame<double> frame;
  frame.pinhole = Pinhole<double>{500, 500, 320, 240};
  add_biased_planes(frame.normals, cam_from_manhattan, 0, random);
  ManhattanRotation<double> stage;
  const std::vector<SO3<double>> none;
  const auto answer = stage.rotate(frame, SO3<double>(), {none, false});
  REQUIRE(answer.trusted());
  REQUIRE(answer.discovered);
  CHECK(angle_between(*answer.discovered, SO3<double>()) == 0);
  CHECK(answer.seen->manhattan_frame == 0);
  CHECK(angle_between_frames(answer.seen->rotation.cam_from_world, cam_from_manhattan) < radians(0.5));
  // In a map that stands, one sighting is not enough.
  stage.forget();
  CHECK_FALSE(stage.rotate(frame, SO3<double>(), {none, true}).seen);
}

TEST_CASE("The axes of lines are those of the Manhattan frame that is seen") {
  Simulation simulation(walk(1));
  ManhattanRotation<double> stage;
  const Frame<double> frame = simulation.frame(0);
  const auto answer = stage.rotate(frame, simulation.truth(0).rotation, {kWorldAxes, true});
  REQUIRE(answer.seen);
  REQUIRE(answer.line_axes.size() == frame.lines.size());
  CHECK(
      std::any_of(answer.line_axes.begin(), answer.line_axes.end(), [](auto axis) { return axis != kNone; }));
  CHECK(std::all_of(answer.line_axes.begin(), answer.line_axes.end(),
                    [](auto axis) { return axis >= kNone && axis < 3; }));
}
