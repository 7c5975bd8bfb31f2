// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/image/segment_refiner.hpp"

#include "support/catch.hpp"
#include "support/drawn_image.hpp"

using namespace sslam;
using namespace sslam::testing;

namespace {

// Brighter above the line y = 50.3 + 0.2 (x - 80).
DrawnImage draw_slope(double step) {
  return draw({160, 100}, [&](double x, double y) { return y < 50.3 + 0.2 * (x - 80) ? 90 + step : 90; });
}

double off(const Vec2<double>& p) {
  return std::abs(p.y() - 50.3 - 0.2 * (p.x() - 80)) / std::hypot(1, 0.2);
}

}  // namespace

TEST_CASE("A rough segment is fitted to the edge") {
  DrawnImage image = draw_slope(60);
  add_noise(image.pixels, 2, 1);
  const Segment2<double> rough{{30, 42}, {130, 59}};  // one to two pixels off
  const RefinedSegment refined = SegmentRefiner::refine(image.view(), rough, {});
  REQUIRE(refined.found);
  CHECK(off(rough.start) > 1);
  CHECK(off(refined.segment.start) < 0.1);
  CHECK(off(refined.segment.end) < 0.1);
  CHECK(refined.segment.length() > 95);
  CHECK(refined.sigma > 0.1);
  CHECK(refined.sigma < 0.4);
}

TEST_CASE("Without an edge that rises to the left hand the segment stays as it was") {
  const Segment2<double> along{{30, 40.3}, {130, 60.3}}, against{along.end, along.start};
  CHECK(SegmentRefiner::refine(draw_slope(60).view(), along, {}).found);
  const RefinedSegment dark_to_the_left = SegmentRefiner::refine(draw_slope(60).view(), against, {});
  CHECK(!dark_to_the_left.found);
  CHECK(dark_to_the_left.segment.start == against.start);
  CHECK(!SegmentRefiner::refine(DrawnImage({160, 100}, 90).view(), along, {}).found);
}

TEST_CASE("A segment that half leaves its edge is cut back to it") {
  const DrawnImage image = draw({160, 100}, [](double x, double y) { return x < 90 && y < 50.3 ? 150 : 90; });
  const RefinedSegment refined = SegmentRefiner::refine(image.view(), {{20, 50}, {120, 50}}, {});
  REQUIRE(refined.found);
  CHECK(refined.segment.end.x() > 85);
  CHECK(refined.segment.end.x() < 95);
}
