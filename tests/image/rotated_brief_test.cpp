// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/image/rotated_brief.hpp"

#include <cmath>

#include "sslam/core/types.hpp"
#include "support/catch.hpp"
#include "support/drawn_image.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

constexpr int kMiddle = 30;

// A smooth pattern around the middle, turned by `angle`, radians, from x to y.
DrawnImage draw_pattern(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return draw({61, 61}, [&](double x, double y) {
    const double u = c * (x - kMiddle) + s * (y - kMiddle), v = c * (y - kMiddle) - s * (x - kMiddle);
    return 120 + 3 * u + 40 * std::sin(0.5 * u) * std::cos(0.35 * v) + 25 * std::sin(0.8 * v + 0.2 * u);
  });
}

}  // namespace

TEST_CASE("The orientation points to the brighter side and turns with the image") {
  const RotatedBrief brief;
  for (const double degrees : {-170.0, -60.0, 0.0, 45.0, 120.0}) {
    const double angle = radians(degrees), c = std::cos(angle), s = std::sin(angle);
    const DrawnImage ramp =
        draw({61, 61}, [&](double x, double y) { return 120 + 3 * (c * (x - kMiddle) + s * (y - kMiddle)); });
    CHECK(brief.orientation(ramp.view(), kMiddle, kMiddle) == Approx(angle).margin(0.05));
  }
}

TEST_CASE("The descriptor of a turned patch is nearly the same, that of another patch is not") {
  const RotatedBrief brief;
  const auto described = [&](const DrawnImage& image, double turn) {
    return brief.describe(image.view(), kMiddle, kMiddle, static_cast<float>(turn));
  };
  const Descriptor upright = described(draw_pattern(0), 0);
  for (const double degrees : {33.75, 90.0, 180.0, -67.5}) {
    const double turn = radians(degrees);
    CHECK(hamming(upright, described(draw_pattern(turn), turn)) < 40);
  }
  CHECK(hamming(upright, described(draw_pattern(radians(90.0)), 0)) > 70);
}
