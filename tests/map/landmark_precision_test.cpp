// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/map/landmark_precision.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "support/catch.hpp"

namespace landmark_precision_test {

using namespace sslam;

constexpr double kFocal = 500, kSigma = 2;  // pixels

// Cameras at these places, not turned, each of which sees point 0 and line 0 by its first feature.
Map<double> seen_from(const std::vector<Vec3<double>>& centres, const Vec3<double>& point,
                      const Vec3<double>& start, const Vec3<double>& end) {
  Map<double> map;
  map.add_point(point, 0);
  map.add_line(Line3<double>::from_points(start, end), start, end, 0);
  for (const Vec3<double>& centre : centres) {
    Keyframe<double> kf;
    kf.cam_from_world.translation = -centre;
    kf.frame.pinhole = {kFocal, kFocal, 320, 240};
    kf.frame.points.resize(1);
    kf.frame.points[0].sigma = kSigma;
    kf.frame.lines.resize(1);
    kf.frame.lines[0].sigma = kSigma;
    map.add_keyframe(std::move(kf).seeing({0}, {0}));
  }
  return map;
}

}  // namespace landmark_precision_test

TEST_CASE("A point is as sure as its rays tell: a pixel's width across each, nothing along it") {
  using namespace landmark_precision_test;
  // Two rays at a right angle, 5 and 10 long.
  const Vec3<double> at{0, 0, 5}, start{-1, 1, 5}, end{1, 1, 5};
  const Map<double> map = seen_from({{0, 0, 0}, {10, 0, 5}}, at, start, end);
  const double near = 5 * kSigma / kFocal, far = 10 * kSigma / kFocal;
  CHECK(sigma_along(map, map.points[0], Vec3<double>(1, 0, 0)) == Approx(near));  // by the first alone
  CHECK(sigma_along(map, map.points[0], Vec3<double>(0, 0, 1)) == Approx(far));   // by the second alone
  CHECK(sigma_along(map, map.points[0], Vec3<double>(0, 1, 0)) ==
        Approx(1 / std::sqrt(1 / (near * near) + 1 / (far * far))));  // by both
}

TEST_CASE("A point whose rays are parallel may be anywhere") {
  using namespace landmark_precision_test;
  const Map<double> map = seen_from({{0, 0, 0}, {0, 0, 1}}, {0, 0, 5}, {-1, 1, 5}, {1, 1, 5});
  CHECK(std::isinf(sigma_along(map, map.points[0], Vec3<double>(0, 0, 1))));
  CHECK(std::isinf(sigma_along(map, map.points[0], Vec3<double>(1, 0, 0))));
}

TEST_CASE("A line is as sure as the planes through its views tell") {
  using namespace landmark_precision_test;
  // Along x, with its middle at (0, 0, 4): one camera looks along z, the other along y.
  const Vec3<double> start{-1, 0, 4}, end{1, 0, 4};
  const Map<double> map = seen_from({{0, 0, 0}, {0, -8, 4}}, {0, 0, 5}, start, end);
  CHECK(sigma_along(map, map.lines[0], Vec3<double>(0, 1, 0)) == Approx(4 * kSigma / kFocal));
  CHECK(sigma_along(map, map.lines[0], Vec3<double>(0, 0, 1)) == Approx(8 * kSigma / kFocal));
  // Cameras in one plane with the line leave it open across their rays.
  const Map<double> level = seen_from({{0, 0, 0}, {1, 0, 0}}, {0, 0, 5}, start, end);
  CHECK(std::isinf(sigma_along(level, level.lines[0], Vec3<double>(0, 0, 1))));
}
