// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/image/segment_detector.hpp"

#include <cmath>

#include "sslam/core/random.hpp"
#include "support/catch.hpp"
#include "support/drawn_image.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

using Segments = std::vector<Segment2<double>>;

Segments detect_segments(const DrawnImage& image, const SegmentDetectorOptions& options = {}) {
  SegmentDetector detector;
  detector.options = options;
  Segments segments;
  detector.detect(image.view(), segments);
  return segments;
}

// The grey value steps by `step` along a line through the middle, whose direction is `angle`, radians.
DrawnImage draw_step(double angle, double step) {
  return draw({200, 160}, [&](double x, double y) {
    const double across = std::sin(angle) * (x - 100) - std::cos(angle) * (y - 80);
    return 100 + (across > 0 ? step : 0);
  });
}

DrawnImage draw_disc(double radius) {
  return draw({200, 160},
              [&](double x, double y) { return std::hypot(x - 100, y - 80) < radius ? 180 : 60; });
}

}  // namespace

TEST_CASE("A step is one segment, across the whole image, with the brighter side to its left") {
  const double angle = GENERATE(-2.9, -1.6, -0.8, 0.0, 0.1, 0.5, 1.3, 2.2, 3.1);
  const Segments segments = detect_segments(draw_step(angle, 60));
  REQUIRE(segments.size() == 1);
  const Vec2<double> direction(std::cos(angle), std::sin(angle));
  CHECK(segments[0].direction().dot(direction) > std::cos(radians(0.5)));
  const Vec2<double> off = segments[0].midpoint() - Vec2<double>(100, 80);
  CHECK(std::abs(direction.x() * off.y() - direction.y() * off.x()) < 0.3);
  const double across_image = std::min(200 / std::abs(direction.x()), 160 / std::abs(direction.y()));
  CHECK(segments[0].length() > across_image - 8);
  CHECK(segments[0].length() < across_image + 4);
}

TEST_CASE("A fainter step needs a smaller error of the gradient") {
  CHECK(detect_segments(draw_step(0.5, 3)).empty());
  CHECK(detect_segments(draw_step(0.5, 3), {.gradient_error = 0.3}).size() == 1);
}

TEST_CASE("A corner is two segments") {
  const Segments segments =
      detect_segments(draw({200, 160}, [](double x, double y) { return x > 60.3 && y > 50.6 ? 180 : 60; }));
  REQUIRE(segments.size() == 2);
  CHECK(std::abs(segments[0].direction().dot(segments[1].direction())) < 0.02);
}

TEST_CASE("A curve is cut into what is straight of it") {
  const double radius = 50;
  const Segments segments = detect_segments(draw_disc(radius));
  CHECK(segments.size() >= 8);
  for (const Segment2<double>& s : segments) {
    const double bulge = radius - std::sqrt(radius * radius - s.length() * s.length() / 4);
    CHECK(bulge < 4);
  }
  CHECK(detect_segments(draw_disc(radius), {.min_density = 0.1}).size() < segments.size());
}

TEST_CASE("Noise is no segment, and the same image gives the same segments") {
  Random random(1);
  DrawnImage image({200, 160});
  for (std::uint8_t& pixel : image.pixels) pixel = grey_level(random.uniform(0.0, 255.0));
  double longest = 0;
  for (const Segment2<double>& s : detect_segments(image)) longest = std::max(longest, s.length());
  CHECK(longest < 20);
  SegmentDetector detector;
  Segments first, second;
  detector.detect(image.view(), first);
  detector.detect(draw_step(1, 60).view(), second);  // leaves nothing behind
  second.clear();
  detector.detect(image.view(), second);
  REQUIRE(first.size() == second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(first[i].start == second[i].start);
    CHECK(first[i].end == second[i].end);
  }
}

TEST_CASE("An image of one grey, or of one row, has no segments") {
  CHECK(detect_segments(DrawnImage({200, 160}, 90)).empty());
  CHECK(detect_segments(DrawnImage({200, 1}, 90)).empty());
  CHECK(detect_segments(DrawnImage({2, 2}, 90)).empty());
}
