// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/image/corner_refiner.hpp"

#include "support/catch.hpp"
#include "support/drawn_image.hpp"

using namespace sslam;
using namespace sslam::testing;

TEST_CASE("A corner moves with the image by fractions of a pixel") {
  // The peak of the measure lies inside the corner of a quadrant, by the same amount wherever that is.
  const auto refined = [](double x, double y) {
    const DrawnImage image =
        draw({40, 40}, [&](double u, double v) { return u > x && v > y ? 180.0 : 60.0; });
    Corner corner{20, 20, 0};
    REQUIRE(CornerRefiner::refine(image.view(), corner));
    CHECK(corner.score > 0);
    return Vec2<double>(corner.x, corner.y);
  };
  const Vec2<double> whole = refined(19.5, 19.5);
  for (const double dx : {-0.4, 0.2, 0.5})
    for (const double dy : {-0.3, 0.0, 0.4}) {
      const Vec2<double> moved = refined(19.5 + dx, 19.5 + dy) - whole;
      CHECK(moved.x() == Approx(dx).margin(0.1));
      CHECK(moved.y() == Approx(dy).margin(0.1));
    }
}

TEST_CASE("An edge and an even patch have no corner") {
  Corner corner{20, 20, 7};
  CHECK(!CornerRefiner::refine(DrawnImage({40, 40}, 90).view(), corner));
  CHECK(!CornerRefiner::refine(
      draw({40, 40}, [](double u, double) { return u > 19.5 ? 180.0 : 60.0; }).view(), corner));
  CHECK(corner.x == 20);
  CHECK(corner.score == 7);
}
