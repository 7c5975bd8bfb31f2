// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/synth/path.hpp"

#include <algorithm>
#include <cmath>

#include "sslam/synth/routes.hpp"
#include "support/catch.hpp"

using namespace sslam;
using namespace sslam::synth;

namespace {

Route route_of(int kind, Random& random) {
  const FreeArea area{{3.0, 2.5}, {1.8, 1.2}};
  switch (kind) {
    case 0:
      return loop_route(area, random);
    case 1:
      return sweep_route(area, 0.7, random);
    case 2:
      return pivot_route(area, random);
    default:
      return tour_route({{1.0, 1.0}, {6.0, 1.0}, {6.0, 4.0}, {4.5, 4.0}, {4.5, 1.4}, {1.0, 1.4}}, random);
  }
}

}  // namespace

TEST_CASE("a path is closed and moves like a person") {
  const int kind = GENERATE(0, 1, 2, 3);
  Random random(static_cast<std::uint64_t>(kind) + 5);
  PathOptions options;
  options.tremor = GENERATE(0.0, 1.0);
  const ClosedPath path(route_of(kind, random), options, 9);
  constexpr double kStep = 1.0 / 30.0;
  double fastest = 0.0, most_turn = 0.0;
  for (double t = 0.0; t < path.lap_seconds(); t += kStep) {
    const SE3<double> a = path.world_from_cam(t), b = path.world_from_cam(t + kStep);
    fastest = std::max(fastest, (b.translation - a.translation).norm() / kStep);
    most_turn = std::max(most_turn, angle_between(a.rotation, b.rotation) / kStep);
  }
  CHECK(fastest < 0.6);
  CHECK(fastest > 0.4);
  CHECK(degrees(most_turn) < 40.0);
  if (options.tremor > 0.0) return;
  const SE3<double> start = path.world_from_cam(0.0), end = path.world_from_cam(path.lap_seconds());
  CHECK((start.translation - end.translation).norm() < 1e-9);
  CHECK(angle_between(start.rotation, end.rotation) < 1e-9);
}

TEST_CASE("velocity and acceleration are continuous") {
  Random random(3);
  const ClosedPath path(route_of(0, random), {}, 2);
  constexpr double kStep = 1e-3;
  const auto at = [&](double t) { return path.world_from_cam(t).translation; };
  const auto acceleration = [&](double t) -> Vec3<double> {
    return (at(t + kStep) - 2.0 * at(t) + at(t - kStep)) / (kStep * kStep);
  };
  double jump = 0.0;
  for (double t = 1.0; t < path.lap_seconds() + 1.0; t += 0.01) {
    jump = std::max(jump, (acceleration(t + 0.001) - acceleration(t)).norm());
  }
  CHECK(jump < 0.05);  // metres per second squared within a millisecond
}

TEST_CASE("a pivot turns before it moves") {
  Random random(4);
  PathOptions options;
  options.tremor = 0.0;
  const ClosedPath path(route_of(2, random), options, 2);
  const SE3<double> a = path.world_from_cam(0.8), b = path.world_from_cam(1.6);
  CHECK((a.translation - b.translation).norm() < 1e-3);
  CHECK(degrees(angle_between(a.rotation, b.rotation)) > 10.0);
}

TEST_CASE("who stands first walks the same way later") {
  Random random(4), again(4);
  PathOptions options;
  options.tremor = 0.0;
  const ClosedPath walk(route_of(0, random), options, 2);
  options.stand = 2.0;
  const ClosedPath stand(route_of(0, again), options, 2);
  for (const double t : {0.0, 0.7, 2.0})
    CHECK((stand.world_from_cam(t).translation - walk.world_from_cam(0.0).translation).norm() < 1e-9);
  CHECK((stand.world_from_cam(2.2).translation - walk.world_from_cam(0.0).translation).norm() > 1e-3);
  for (const double t : {1.0, 5.0}) {  // half a second is lost by starting
    const SE3<double> a = walk.world_from_cam(t), b = stand.world_from_cam(t + 2.5);
    CHECK((a.translation - b.translation).norm() < 1e-9);
    CHECK(angle_between(a.rotation, b.rotation) < 1e-9);
  }
  CHECK(std::abs(stand.first_lap_seconds() - walk.first_lap_seconds() - 2.5) < 1e-9);
}

TEST_CASE("a shake turns the camera quickly and leads nowhere") {
  Random random(4), again(4);
  PathOptions options;
  const ClosedPath calm(route_of(0, random), options, 2);
  options.shake = 1.0;
  const ClosedPath shaken(route_of(0, again), options, 2);
  double squares = 0.0, fastest = 0.0;
  SO3<double> before;
  constexpr int kSteps = 900;
  for (int i = 0; i < kSteps; ++i) {
    const SE3<double> a = calm.world_from_cam(i / 90.0), b = shaken.world_from_cam(i / 90.0);
    CHECK((a.translation - b.translation).norm() < 0.004);
    const SO3<double> shake = b.rotation * a.rotation.inverse();
    squares += std::pow(degrees(angle_between(a.rotation, b.rotation)), 2);
    if (i > 0) fastest = std::max(fastest, degrees(angle_between(shake, before)) * 90.0);
    before = shake;
  }
  const double rms = std::sqrt(squares / kSteps);
  CHECK((rms > 0.08 && rms < 0.3));
  CHECK((fastest > 4.0 && fastest < 30.0));  // degrees per second
}
