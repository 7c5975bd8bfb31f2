// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/synth/clutter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "support/catch.hpp"
#include "synth/seen_from.hpp"

namespace clutter_test {

using namespace sslam;
using namespace sslam::synth;

TEST_CASE("clutter is added to the same house, clear of the camera's path, at any heading") {
  constexpr std::size_t kSides = 5;  // of each thing
  std::size_t things = 0, asked = 0, on_tables = 0, square = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    HouseOptions options = unlit(seed);
    options.rooms = seed % 3 ? 1 : 3;
    const House tidy = build_house(options);
    options.clutter = 30;
    asked += 30;
    const House house = build_house(options);
    INFO("seed " << seed);
    const std::size_t first = tidy.scene.faces.size(), all = house.scene.faces.size();
    REQUIRE((all > first && (all - first) % kSides == 0));
    for (std::size_t i = 0; i < first; ++i)
      REQUIRE(house.scene.faces[i].origin == tidy.scene.faces[i].origin);
    things += (all - first) / kSides;
    for (std::size_t i = first; i < all; ++i) {
      const Face& face = house.scene.faces[i];
      const bool on_floor = face.origin.z() < 0.3;
      if (i % kSides == first % kSides) {
        on_tables += !on_floor;
        square +=
            std::abs(std::remainder(degrees(std::atan2(face.along_s.y(), face.along_s.x())), 90.0)) < 2.0;
      }
      for (double t = 0.0; on_floor && t < house.path.lap_seconds(); t += 0.5) {
        Vec3<double> below = house.path.world_from_cam(t).translation;
        below.z() = face.origin.z();
        REQUIRE(distance(face, below) > 0.4);
      }
    }
  }
  CHECK(things > asked * 85 / 100);  // a corridor has little room beside the path
  CHECK((on_tables > things / 10 && on_tables < things / 2));
  CHECK(square < things / 10);  // 4 of 90 degrees by chance
}

TEST_CASE("things on a table lie on its top") {
  Scene scene;
  Decor decor(scene, Richness::kPoor, 0.02f, 1);
  FloorSpace space({});
  const FloorArea top{{{1.0, 2.0}, 0.4}, {-0.7, 0.0}, {0.7, 0.8}};
  const Wall wall = wall_between({0.0, 0.0}, {0.3, 0.0}, 2.5);
  const int placed = ClutterPlacer(scene, decor, space, {{top, 0.74, 0, 0}}, 3).scatter(60, {wall});
  REQUIRE(placed > 3);
  int on_top = 0;
  for (const Face& face : scene.faces) {
    if (face.normal().z() > 0.5 || face.origin.z() < 0.7) continue;
    CHECK(face.origin.z() == 0.74);
    CHECK(top.distance(face.origin.head<2>()) < 1e-9);
    ++on_top;
  }
  CHECK(on_top > 4 * 3);
}

}  // namespace clutter_test
