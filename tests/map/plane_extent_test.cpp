// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/map/plane_extent.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "support/catch.hpp"

namespace plane_extent_test {

using namespace sslam;

// Of the plane z = 2, which these places lie on.
PlaneExtent<double> extent(const std::vector<Vec2<double>>& places) {
  PlaneExtent<double> out(Vec3<double>::UnitZ());
  for (const Vec2<double>& place : places) out.add(Vec3<double>(place.x(), place.y(), 2));
  return out;
}

const std::vector<Vec2<double>> kCross{{-3, 0}, {3, 0}, {0, -1}, {0, 1}};

}  // namespace plane_extent_test

TEST_CASE("A plane covers the rectangle of its members, and a reach around it") {
  using namespace plane_extent_test;
  const PlaneExtent<double> cross = extent(kCross);
  CHECK(cross.places == 4);
  CHECK(cross.covers({2.9, 0.9, 2}, 0));
  CHECK(cross.covers({2.9, -0.9, 7}, 0));  // as seen along the normal
  CHECK_FALSE(cross.covers({3.2, 0, 2}, 0.1));
  CHECK(cross.covers({3.2, 0, 2}, 0.3));
  CHECK_FALSE(cross.covers({0, 1.2, 2}, 0.1));
  CHECK_FALSE(extent({}).covers({0, 0, 2}, 10));
}

TEST_CASE("Two extents meet if their rectangles do, within the reach") {
  using namespace plane_extent_test;
  const PlaneExtent<double> cross = extent(kCross);
  CHECK(cross.meets(extent({{2, 0.5}, {8, 4}}), 0));
  CHECK_FALSE(cross.meets(extent({{4, 0}, {8, 0.5}}), 0.9));
  CHECK(cross.meets(extent({{4, 0}, {8, 0.5}}), 1.1));
  CHECK_FALSE(cross.meets(extent({{0, -9}, {1, -2}}), 0.9));
}

TEST_CASE("The least spread is that across the places, and nothing where they lie on a line") {
  using namespace plane_extent_test;
  CHECK(extent(kCross).least_spread() == Approx(std::sqrt(0.5)));
  CHECK(extent({{0, 0}, {1, 2}, {2, 4}, {-3, -6}}).least_spread() < 1e-7);
  CHECK(extent({{0, 0}, {5, 5}}).least_spread() == 0);
}

TEST_CASE("The corners lie on the plane, in order around the rectangle") {
  using namespace plane_extent_test;
  const auto corners = extent(kCross).corners({Vec3<double>::UnitZ(), 2});
  double length = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(corners[i].z() == Approx(2));
    CHECK(std::abs(corners[i].x()) == Approx(3));
    CHECK(std::abs(corners[i].y()) == Approx(1));
    length += (corners[(i + 1) % 4] - corners[i]).norm();
  }
  CHECK(length == Approx(16));
}

TEST_CASE("Members give a plane of the map its extent: points, and both ends of lines") {
  using namespace plane_extent_test;
  Map<double> map;
  const LandmarkId plane = map.add_plane({Vec3<double>::UnitZ(), 2}, kNone);
  const LandmarkId empty = map.add_plane({Vec3<double>::UnitX(), 1}, kNone);
  map.lay_point(map.add_point({-1, 4, 2}, 0), plane);
  map.add_point({50, 50, 2}, 0);  // on no plane
  const Vec3<double> start{0, 0, 2}, end{6, 1, 2};
  map.lay_line(map.add_line(Line3<double>::from_points(start, end), start, end, 0), plane);
  const PlaneExtent<double> found = extent_of(map, plane);
  CHECK(found.places == 3);
  CHECK(found.covers({5.9, 3.9, 2}, 0));
  CHECK_FALSE(found.covers({50, 50, 2}, 1));
  std::vector<PlaneExtent<double>> all;
  gather_extents(map, all);
  REQUIRE(all.size() == 2);
  CHECK(all[static_cast<std::size_t>(plane)].places == 3);
  CHECK(all[static_cast<std::size_t>(empty)].places == 0);
}
