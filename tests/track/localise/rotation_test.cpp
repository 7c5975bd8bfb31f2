// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/localise/rotation.hpp"

#include <cmath>

#include "support/catch.hpp"
#include "support/random_draws.hpp"
#include "track/simulation.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

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

TrackedFrame<double> frame_with_normals(Simulation& simulation, double bias_deg, double plane_sigma_deg,
                                        Random& random) {
  TrackedFrame<double> tracked;
  Frame<double> frame = simulation.frame(0);
  add_biased_planes(frame.normals, simulation.truth(0).rotation, bias_deg, random);
  frame.normals.plane_sigma = static_cast<float>(radians(plane_sigma_deg));
  tracked.adopt(frame);
  return tracked;
}

double standard_deviation(const RotationObservation<double>& observation) {
  return std::sqrt(observation.covariance.trace() / 3);
}

}  // namespace

TEST_CASE("What the normals of a plane get wrong together is not averaged away") {
  Simulation simulation(walk(1));
  Random random(3);
  for (int trial = 0; trial < 10; ++trial) {
    TrackedFrame<double> frame = frame_with_normals(simulation, 5, 5, random);
    frame.frame.lines.clear();
    frame.line_axes.clear();
    ManhattanRotation<double> stage;
    stage.reset({SO3<double>()});
    const auto answer = stage.rotate(frame, simulation.truth(0).rotation, true);
    CHECK(answer.axes_seen >= 2);
    CHECK(!answer.trusted);
    REQUIRE(frame.manhattan);
    CHECK(standard_deviation(*frame.manhattan) > radians(2.0));
    const double error = angle_between(frame.manhattan->cam_from_world, simulation.truth(0).rotation);
    CHECK(error < 4 * standard_deviation(*frame.manhattan));
  }
}

TEST_CASE("Lines decide where normals are known to be off") {
  Simulation simulation(walk(1));
  Random random(4);
  double told = 0, untold = 0;
  for (int trial = 0; trial < 10; ++trial) {
    for (double* sum : {&told, &untold}) {
      TrackedFrame<double> frame = frame_with_normals(simulation, 5, sum == &told ? 5 : 0, random);
      ManhattanRotation<double> stage;
      stage.reset({SO3<double>()});
      CHECK(stage.rotate(frame, simulation.truth(0).rotation, true).trusted);
      REQUIRE(frame.manhattan);
      *sum += angle_between(frame.manhattan->cam_from_world, simulation.truth(0).rotation);
    }
  }
  CHECK(told / 10 < radians(1.0));
  CHECK(told < untold);
}

TEST_CASE("A second Manhattan frame gives the same world's rotation, and is known again") {
  const SO3<double> wing = SO3<double>::exp(Vec3<double>(0, radians(35.0), 0));
  ManhattanRotation<double> stage;
  stage.reset({SO3<double>()});
  Random random(5);
  // What the camera sees while it turns: the first frame, the wing, the first, the wing.
  int step = 0;
  for (const bool in_wing : {false, true, false, true})
    for (int i = 0; i < 8; ++i, ++step) {
      const SO3<double> cam_from_world = SO3<double>::exp(Vec3<double>(0.1, 0.02 * step, -0.05));
      TrackedFrame<double> frame;
      Frame<double> seen;
      seen.pinhole = Pinhole<double>{500, 500, 320, 240};
      add_biased_planes(seen.normals, in_wing ? cam_from_world * wing : cam_from_world, 0, random);
      frame.adopt(seen);
      const auto answer = stage.rotate(frame, cam_from_world, true);
      const bool new_to_it = step >= 8 && step < 10;  // believed at the third sighting
      CHECK(answer.trusted == !new_to_it);
      REQUIRE(frame.manhattan.has_value() == !new_to_it);
      if (new_to_it) continue;
      CHECK(frame.manhattan_frame == (in_wing ? 1U : 0U));
      CHECK(angle_between(frame.manhattan->cam_from_world, cam_from_world) < radians(0.5));
    }
  CHECK(stage.world_from_manhattan().size() == 2);
}
