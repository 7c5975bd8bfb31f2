// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/image/segment_merger.hpp"

#include "support/catch.hpp"

using namespace sslam;

namespace {

std::vector<Segment2<double>> merged(std::vector<Segment2<double>> segments) {
  SegmentMerger().merge(segments, {});
  return segments;
}

}  // namespace

TEST_CASE("the pieces of a broken segment become one") {
  const auto whole = merged({{{60, 41}, {100, 61}}, {{0, 11}, {40, 31}}, {{46, 34}, {58, 40}}});
  REQUIRE(whole.size() == 1);
  CHECK((whole[0].start - Vec2<double>(0, 11)).norm() < 0.1);
  CHECK((whole[0].end - Vec2<double>(100, 61)).norm() < 0.1);
}

TEST_CASE("a segment that lies on another is absorbed") {
  const auto one = merged({{{0, 0}, {100, 0}}, {{20, 0.6}, {60, 0.8}}});
  REQUIRE(one.size() == 1);
  CHECK(one[0].length() == Approx(100).margin(0.5));
}

TEST_CASE("segments that differ stay apart") {
  CHECK(merged({{{0, 0}, {100, 0}}, {{100, 0}, {0, 0}}}).size() == 2);     // opposite edges
  CHECK(merged({{{0, 0}, {100, 0}}, {{0, 4}, {100, 4}}}).size() == 2);     // parallel
  CHECK(merged({{{0, 0}, {100, 0}}, {{140, 0}, {200, 0}}}).size() == 2);   // far along the line
  CHECK(merged({{{0, 0}, {100, 0}}, {{105, 0}, {200, 20}}}).size() == 2);  // at an angle
  CHECK(merged({{{0, 0}, {10, 0}}, {{18, 0}, {26, 0}}}).size() == 2);      // short, with a gap as long
}

TEST_CASE("the result is sorted and without segments of no length") {
  const auto sorted = merged({{{0, 0}, {10, 0}}, {{5, 5}, {5, 5}}, {{0, 50}, {30, 50}}});
  REQUIRE(sorted.size() == 2);
  CHECK(sorted[0].length() > sorted[1].length());
  CHECK(merged({}).empty());
}
