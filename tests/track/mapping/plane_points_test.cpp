// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/mapping/plane_points.hpp"

#include <algorithm>

#include "support/catch.hpp"
#include "support/map_errors.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

constexpr double kMedianDepth = 5;
constexpr KeyframeId kNewest = 3;

// Keyframes that stand nearly still before a wall; of the points on it, one in four has a landmark.
Map<double> before_wall(MapScene& scene) {
  Map<double> map = scene.make_map();
  scene.add_planes(map);
  for (auto& kf : map.keyframes)
    for (std::size_t i = 0; i < kf.frame.points.size(); ++i) {
      Random random(static_cast<std::uint64_t>(kf.point_landmarks[i]) + 1);
      for (auto& word : kf.frame.points[i].descriptor.words)
        word = (std::uint64_t{random.below(1U << 31)} << 32) + random.below(1U << 31);
    }
  for (std::size_t i = 0; i < map.points.size(); ++i)
    if (map.points[i].alive && i % 4 != 0) map.erase_point(static_cast<LandmarkId>(i));
  map.collect_free_ids();
  for (const auto& kf : map.keyframes) map.update_covisibility(kf.id);
  return map;
}

std::size_t alive(const Map<double>& map) {
  return static_cast<std::size_t>(
      std::count_if(map.points.begin(), map.points.end(), [](const auto& p) { return p.alive; }));
}

}  // namespace

TEST_CASE("Rays that meet a known plane give new points where landmarks are few") {
  MapScene scene({.points = 1200, .lines = 0}, sweep(4, 0.01));
  Map<double> map = before_wall(scene);
  const auto before = alive(map);
  std::vector<std::uint8_t> old(map.points.size() * 5, 0);
  for (std::size_t i = 0; i < map.points.size(); ++i) old[i] = map.points[i].alive;
  PlanePoints<double> points;
  points.options.few_landmarks = 100000;
  const int added = points.create(map, kNewest, kMedianDepth);
  CHECK(added > 50);
  CHECK(alive(map) == before + static_cast<std::size_t>(added));
  int right = 0;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const PointLandmark<double>& p = map.points[i];
    if (!p.alive || old[i] != 0) continue;
    REQUIRE(p.plane != kNone);
    CHECK(std::abs(map.planes[map.index(p.plane)].plane.offset(p.position)) < 1e-9);
    REQUIRE(p.observations.size() == 2);
    right += std::any_of(scene.points.begin(), scene.points.end(),
                         [&](const Vec3<double>& x) { return (x - p.position).norm() < 0.05; });
  }
  CHECK(right > 0.9 * added);
}

TEST_CASE("Planes give no points where landmarks are many, nor far from what lies on them") {
  MapScene scene({.points = 1200, .lines = 0}, sweep(4, 0.01));
  Map<double> map = before_wall(scene);
  PlanePoints<double> points;
  CHECK(points.create(map, kNewest, kMedianDepth) == 0);  // switched off
  points.options.few_landmarks = 10;
  CHECK(points.create(map, kNewest, kMedianDepth) == 0);  // it sees more
  points.options.few_landmarks = 100000;
  for (auto& p : map.points)
    if (p.alive && p.plane != kNone && (p.position.head<2>() - Vec2<double>(0, 0)).norm() > 0.3)
      p.plane = kNone;  // what is left of the walls is a patch
  points.options.reach = 0;
  CHECK(points.create(map, kNewest, kMedianDepth) < 10);
}
