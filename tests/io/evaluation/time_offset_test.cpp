// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/io/evaluation/time_offset.hpp"

#include <cmath>
#include <string>

#include "io/errors.hpp"
#include "sslam/core/random.hpp"

namespace time_offset_test {
namespace {

using namespace sslam;

// A walk that never does the same twice.
SE3<double> walk(double t) {
  const double turn = 0.8 * std::sin(0.5 * t) + 0.3 * std::sin(1.7 * t + 1) + 0.1 * std::sin(3.1 * t);
  const double nod = 0.2 * std::sin(0.9 * t + 0.3);
  SE3<double> pose;
  pose.rotation = SO3<double>::exp(Vec3<double>(0, turn, 0)) * SO3<double>::exp(Vec3<double>(nod, 0, 0));
  pose.translation = Vec3<double>(std::sin(0.31 * t) + 0.2 * std::sin(1.3 * t), 0.1 * std::sin(t * 0.77),
                                  0.4 * t + 0.3 * std::cos(0.9 * t));
  return pose;
}

// Every `step` seconds of its own clock, which shows `late` more than the other one.
template <class Path>
io::Trajectory recorded(const Path& path, double from, double to, double step, double late) {
  io::Trajectory poses;
  for (double t = from; t < to; t += step) poses.push_back({t + late, path(t)});
  return poses;
}

// The same in another world, smaller, with noise.
io::Trajectory seen_elsewhere(io::Trajectory poses) {
  Random random(7);
  const SE3<double> world{SO3<double>::exp(Vec3<double>(0.3, 1.9, -0.4)), Vec3<double>(5, -2, 9)};
  for (io::StampedPose& pose : poses) {
    pose.world_from_cam = world * pose.world_from_cam;
    pose.world_from_cam.translation *= 0.37;
    for (double& x : pose.world_from_cam.translation) x += random.uniform(-2e-4, 2e-4);
    const Vec3<double> shake(random.uniform(-2e-4, 2e-4), random.uniform(-2e-4, 2e-4), 0);
    pose.world_from_cam.rotation = pose.world_from_cam.rotation * SO3<double>::exp(shake);
  }
  return poses;
}

}  // namespace

TEST_CASE("The offset of two clocks is found to a fraction of a frame, whatever world and scale") {
  const io::Trajectory truth = recorded(walk, 0, 40, 0.01, 0);
  for (const double late : {-0.3731, 0.0, 0.0123, 2.5, 1.7e9}) {
    io::Trajectory estimate = seen_elsewhere(recorded(walk, 6, 33, 1 / 30.0, late));
    estimate.erase(estimate.begin() + 200, estimate.begin() + 260);  // lost for two seconds
    const io::TimeOffset found = io::find_time_offset(truth, estimate);
    INFO("late " << late << ", found " << found.offset << ", likeness " << found.likeness);
    REQUIRE(found.problem.empty());
    CHECK(std::abs(found.offset + late) < 0.003);
    CHECK(found.likeness > 0.95);
    CHECK(found.likeness <= 1 + 1e-9);
  }
}

TEST_CASE("Motions that do not tell the offset of their clocks say why") {
  const io::Trajectory truth = recorded(walk, 0, 40, 0.02, 0);
  const auto problem = [&](const io::Trajectory& a, const io::Trajectory& b) {
    return io::find_time_offset(a, b).problem;
  };
  const auto steady = [](double t) {
    return SE3<double>{SO3<double>::exp(Vec3<double>(0, 0.1 * t, 0)), Vec3<double>(t, 0, 0)};
  };
  const io::Trajectory straight = recorded(steady, 0, 40, 0.02, 0);
  CHECK(testing::contains(problem(straight, straight), "neither turn rate nor speed changes"));
  const auto round = [](double t) {
    return SE3<double>{SO3<double>::exp(Vec3<double>(0, std::sin(2 * t), 0)),
                       Vec3<double>(std::sin(2 * t), std::cos(4 * t), 0)};
  };
  CHECK(testing::contains(problem(recorded(round, 0, 40, 0.02, 0), recorded(round, 5, 30, 0.02, 0)),
                          "repeats itself"));
  const auto another = [](double t) { return walk(500 - 1.7 * t); };
  CHECK_FALSE(problem(truth, recorded(another, 0, 40, 0.02, 0)).empty());
  CHECK(testing::contains(problem(truth, recorded(walk, 0, 0.1, 0.02, 0)), "fewer than 20 poses"));
  const io::Trajectory still(30, {0, SE3<double>()});
  CHECK_FALSE(problem(truth, still).empty());
}

}  // namespace time_offset_test
