// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/synth/doors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/catch.hpp"
#include "synth/seen_from.hpp"

namespace doors_test {

using namespace sslam;
using namespace sslam::synth;

namespace {

// The faces of the size of a leaf: one of a closed door, two of an open one.
std::vector<Face> leaves(const House& house, double width, double height) {
  std::vector<Face> found;
  std::copy_if(house.scene.faces.begin(), house.scene.faces.end(), std::back_inserter(found),
               [&](const Face& face) {
                 return std::abs(face.width - width) < 1e-6 && std::abs(face.height - height) < 1e-6;
               });
  return found;
}

House with_door(std::uint64_t seed, bool ajar) {
  HouseOptions options = unlit(seed);
  options.doors_ajar = ajar;
  return build_house(options);
}

}  // namespace

TEST_CASE("a door that is ajar has its leaf turned about the hinge by 5 to 70 degrees") {
  double least = 90.0, most = 0.0;
  int into = 0, doors = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const std::vector<Face> closed = leaves(with_door(seed, false), 0.9, 2.05);
    const std::vector<Face> open = leaves(with_door(seed, true), 0.894, 2.04);
    INFO("seed " << seed);
    REQUIRE((closed.size() == 1 && open.size() == 2));
    const double angle = degrees(std::acos(std::abs(closed[0].along_s.dot(open[0].along_s))));
    CHECK((angle > 5.0 && angle < 70.0));
    least = std::min(least, angle);
    most = std::max(most, angle);
    double hinge = 1e9;  // of the ends of the leaf and of the opening
    for (const double a : {0.0, closed[0].width})
      for (const double b : {0.0, open[0].width})
        hinge = std::min(hinge, (closed[0].at(a, 0.0) - open[0].at(b, 0.0)).norm());
    CHECK(hinge < 0.12);
    const Vec3<double> out = open[0].at(0.5 * open[0].width, 0.0) - closed[0].at(0.0, 0.0);
    into += closed[0].normal().dot(out) > 0.0;
    ++doors;
  }
  CHECK(least < 10.0);
  CHECK(most > 65.0);
  CHECK((into > doors / 10 && into < doors * 9 / 10));
}

TEST_CASE("nobody looks out of the house past a door that is ajar") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Face door = leaves(with_door(seed, false), 0.9, 2.05).at(0);
    const House open = with_door(seed, true);
    INFO("seed " << seed);
    for (const double along : {-0.3, 0.45, 1.2}) {
      for (const double high : {0.4, 1.5}) {
        const Vec3<double> from = door.at(along, high) + 0.7 * door.normal();
        CHECK(holes(open.scene, looking(from, door.at(0.45, 1.0))) == 0);
      }
    }
  }
}

TEST_CASE("doors ajar leave the camera its way, in one room or three") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    HouseOptions options = unlit(seed);
    options.doors_ajar = true;
    options.rooms = seed % 2 ? 1 : 3;
    options.world = static_cast<World>(seed % 2 ? seed / 2 : 0);
    INFO("seed " << seed);
    CHECK(nearest_to_path(build_house(options)) > 0.25);
  }
}

}  // namespace doors_test
