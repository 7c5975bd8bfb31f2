// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/map/landmark.hpp"

#include <vector>

#include "support/catch.hpp"

namespace landmark_test {

using namespace sslam;

// Observed by keyframes 0, 1, ..., from these places (world), by features of 2 pixels.
PointLandmark<double> seen_from(const std::vector<Vec3<double>>& centres, const Vec3<double>& position) {
  PointLandmark<double> point = new_point_landmark(position, 0);
  for (std::size_t k = 0; k < centres.size(); ++k) {
    MapDoor::open(point.observations).push_back({static_cast<KeyframeId>(k), 0});
    point.take_view(centres[k], 2.0);
  }
  return point;
}

}  // namespace landmark_test

TEST_CASE(
    "The viewing direction of a point is the mean of those to its cameras, its extent that of the last") {
  using namespace landmark_test;
  const Vec3<double> at{1, 2, 3};
  const PointLandmark<double> one = seen_from({at + Vec3<double>(0, 0, -4)}, at);
  CHECK((one.viewing_direction - Vec3<double>(0, 0, -1)).norm() < 1e-15);
  CHECK(one.extent == Approx(8));
  const PointLandmark<double> two =
      seen_from({at + Vec3<double>(0, 0, -4), at + Vec3<double>(10, 0, 0)}, at);  // far ones count as much
  CHECK((two.viewing_direction - Vec3<double>(1, 0, -1).normalized()).norm() < 1e-15);
  CHECK(two.extent == Approx(20));
}

TEST_CASE("A camera at the point itself leaves its viewing direction finite") {
  using namespace landmark_test;
  const Vec3<double> at{1, 2, 3};
  const PointLandmark<double> point = seen_from({at + Vec3<double>(0, -2, 0), at}, at);
  CHECK((point.viewing_direction - Vec3<double>(0, -1, 0)).norm() < 1e-12);
  CHECK(point.extent == 0);
}

TEST_CASE("A landmark tells which keyframes see it") {
  using namespace landmark_test;
  const PointLandmark<double> point = seen_from({{0, 0, 0}, {1, 0, 0}}, {0, 0, 5});
  CHECK(point.seen_by(0));
  CHECK(point.seen_by(1));
  CHECK_FALSE(point.seen_by(2));
  CHECK_FALSE(new_point_landmark(Vec3<double>(0, 0, 5), 0).seen_by(0));
}

TEST_CASE("A new line knows its creator and its ends, and counts as found once") {
  using namespace landmark_test;
  const Vec3<double> start{0, 0, 2}, end{1, 0, 2};
  const auto line = new_line_landmark(Line3<double>::from_points(start, end), start, end, 7);
  CHECK(line.first_keyframe == 7);
  CHECK(line.start == start);
  CHECK(line.end == end);
  CHECK(line.visible == 1);
  CHECK(line.found == 1);
  CHECK(line.axis == kNone);
  CHECK(line.alive);
}

TEST_CASE("Features without a landmark do not count as held") {
  using namespace sslam;
  CHECK(count_held({kNone, 3, kNone, 0}) == 2);
  CHECK(count_held({}) == 0);
}
