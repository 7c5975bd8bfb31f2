// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/synth/off_square.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/catch.hpp"
#include "synth/seen_from.hpp"

namespace off_square_test {

using namespace sslam;
using namespace sslam::synth;

namespace {

// By how many degrees each wall is off the side of a rectangle.
std::vector<double> wall_angles(const House& house) {
  std::vector<double> angles;
  const Outline& outline = house.outline;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2<double> run = outline[(i + 1) % outline.size()] - outline[i];
    angles.push_back(
        std::remainder(degrees(std::atan2(run.y(), run.x())) - 90.0 * static_cast<double>(i), 360.0));
  }
  return angles;
}

}  // namespace

TEST_CASE("walls are off square by the standard deviation that was asked for") {
  double sum = 0.0, squares = 0.0, most = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    HouseOptions options = unlit(seed);
    options.off_square = 3.0;
    for (const double angle : wall_angles(build_house(options))) {
      sum += angle;
      squares += angle * angle;
      most = std::max(most, std::abs(angle));
      ++count;
    }
  }
  REQUIRE(count == 600);
  CHECK(std::abs(sum / count) < 0.5);
  CHECK(std::sqrt(squares / count) == Approx(3.0).epsilon(0.1));
  CHECK(most < 3.0 * 2.63);
}

TEST_CASE("an outline whose edges turned about their middles is closed, and has the middles within") {
  const Outline square = rectangle({-3.0, -2.0}, {3.0, 2.0});
  OffSquare off(5.0, 4), same(5.0, 4);
  const Outline turned = turned_edges(square, off);
  REQUIRE(turned.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const double nominal = 0.5 * 3.14159265358979 * static_cast<double>(i), angle = same.angle();
    const Vec2<double> run = turned[(i + 1) % 4] - turned[i];
    CHECK(std::remainder(std::atan2(run.y(), run.x()) - nominal - angle, kTurn) == Approx(0.0).margin(1e-9));
    const Vec2<double> middle = 0.5 * (square[i] + square[(i + 1) % 4]) - turned[i];
    CHECK(run.x() * middle.y() - run.y() * middle.x() == Approx(0.0).margin(1e-9));
    CHECK((middle.dot(run) > 0.0 && middle.dot(run) < run.squaredNorm()));
  }
}

TEST_CASE("a room off square has no gap, and leaves the camera its way") {
  const double angle = GENERATE(2.0, kMostOffSquare);
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    HouseOptions options = unlit(seed);
    options.off_square = angle;
    options.path = static_cast<PathKind>(seed % 3);
    options.doors_ajar = seed % 2 == 1;
    options.clutter = seed % 2 == 1 ? 30 : 0;
    const House house = build_house(options);
    INFO("seed " << seed);
    CHECK(nearest_to_path(house) > 0.25);
    for (double t = 0.0; t < house.path.lap_seconds(); t += 1.7)
      CHECK(holes(house.scene, house.path.world_from_cam(t)) == 0);
  }
}

TEST_CASE("furniture off square stands along its wall, plus a small angle of its own") {
  HouseOptions options = unlit(5);
  options.off_square = 2.0;
  const House house = build_house(options);
  const std::vector<double> walls = wall_angles(house);
  int along = 0, own = 0;
  for (const Face& face : house.scene.faces) {
    const Vec3<double> n = face.normal();
    if (std::abs(n.z()) > 0.5) continue;
    const double heading = std::remainder(degrees(std::atan2(n.y(), n.x())), 90.0);
    const auto is = [&](double angle) { return std::abs(heading - angle) < 1e-6; };
    if (std::any_of(walls.begin(), walls.end(), is) || is(0.0)) {  // lamps hang square
      ++along;
    } else {
      ++own;
      CHECK(std::abs(heading) < 2.0 * 2.0 * 2.63);
    }
  }
  CHECK(along > 50);
  CHECK(own > 50);
}

}  // namespace off_square_test
