// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/image/level_lines.hpp"

#include <algorithm>

#include "sslam/geometry/line2.hpp"
#include "support/catch.hpp"
#include "support/drawn_image.hpp"

using namespace sslam;
using namespace sslam::testing;

TEST_CASE("Level lines run across the slope, with the brighter side to their left") {
  LevelLines lines;
  lines.compute(draw({20, 10}, [](double x, double) { return 10 * x; }).view(), 1);
  CHECK(lines.places().size() == 19 * 9);
  for (const int place : lines.places()) {
    CHECK(lines.slope(place) == Approx(10));
    // Down the screen: what lies to the right of it is then to the left hand.
    CHECK(std::abs(lines.direction(place).y()) == Approx(1));
    CHECK(cross(Vec2<float>(lines.direction(place)), Vec2<float>(1, 0)) < 0);
  }
}

TEST_CASE("The steepest places come first, and flat ones have no level line") {
  LevelLines lines;
  const auto two_steps = [](double x, double) { return 50.0 + (x > 9.5 ? 5 : 0) + (x > 19.5 ? 95 : 0); };
  lines.compute(draw({30, 10}, two_steps).view(), 3);
  REQUIRE(lines.places().size() == 2 * 9);
  for (std::size_t i = 0; i < 9; ++i) CHECK(lines.pixel(lines.places()[i]).x() == Approx(19.5));
  for (std::size_t i = 9; i < 18; ++i) CHECK(lines.pixel(lines.places()[i]).x() == Approx(9.5));
  lines.compute(DrawnImage({30, 10}, 90).view(), 3);
  CHECK(lines.places().empty());
}

TEST_CASE("Around a place lie its eight neighbours, within the arrays even at the border") {
  LevelLines lines;
  lines.compute(draw({8, 6}, [](double x, double y) { return 10 * x + 7 * y; }).view(), 1);
  const auto size = static_cast<int>(lines.size());
  for (const int place : lines.places())
    for (const int other : lines.around(place)) {
      CHECK(other >= 0);
      CHECK(other < size);
      if (lines.slope(other) > 0)
        CHECK((lines.pixel(other) - lines.pixel(place)).cwiseAbs().maxCoeff() == Approx(1));
    }
}
