// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/loops/map_join.hpp"

#include <cmath>

#include "sslam/io/maps/map_check.hpp"
#include "support/catch.hpp"
#include "support/map_scene.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

Map<double> map_of(MapScene& scene) {
  Map<double> map = scene.make_map();
  scene.add_planes(map);
  return map;
}

// Largest distance, pixels, of a point from the feature that observes it, and of a line from its segment's
// ends.
double largest_miss(const Map<double>& map) {
  double largest = 0;
  for (const auto& point : map.points)
    for (const Observation& o : point.observations) {
      const auto& kf = map.keyframes[map.index(o.keyframe)];
      const Vec2<double> seen = kf.frame.points[map.index(o.feature)].pixel;
      largest =
          std::max(largest, (kf.frame.pinhole.project(kf.cam_from_world * point.position) - seen).norm());
    }
  for (const auto& line : map.lines)
    for (const Observation& o : line.observations) {
      const auto& kf = map.keyframes[map.index(o.keyframe)];
      const Vec3<double> normal = transform(kf.cam_from_world, line.line).moment.normalized();
      const auto& segment = kf.frame.lines[map.index(o.feature)].segment;
      for (const Vec2<double>& end : {segment.start, segment.end})
        largest = std::max(largest, 525 * std::abs(normal.dot(kf.frame.pinhole.unproject(end).normalized())));
    }
  return largest;
}

}  // namespace

TEST_CASE("A map that becomes part of another holds together there") {
  MapScene first(MapSceneOptions{}, sweep(6)), second(MapSceneOptions{.seed = 5}, sweep(9));
  Map<double> map = map_of(first), other = map_of(second);
  other.erase_keyframe(4, 5);  // a parent goes along
  const Map<double> before = map, moved = other;
  const Sim3<double> map_from_other{SO3<double>::exp({0, radians(91.0), 0}), {3, -1, 7}, 2.5};
  const IdShift shift = append(map, other, map_from_other, radians(15.0));

  REQUIRE_NOTHROW(io::check_map(map));
  CHECK(shift.keyframes == 6);
  CHECK(map.keyframes.size() == 15);
  CHECK(map.points.size() == before.points.size() + moved.points.size());
  CHECK(map.planes.size() == 12);
  CHECK(map.world_from_manhattan.size() == 1);
  CHECK(largest_miss(map) < 1.2 * std::max(largest_miss(before), largest_miss(moved)));

  for (std::size_t i = 0; i < moved.lines.size(); ++i) {
    const auto& line = map.lines[before.lines.size() + i];
    REQUIRE(line.alive == moved.lines[i].alive);
    if (!line.alive) continue;
    CHECK(line.first_keyframe == moved.lines[i].first_keyframe + 6);
    // The name of its axis is still true, to the degree by which the worlds were said to stand inconsistent.
    const double along = std::abs(map.axis(line.axis).dot((line.end - line.start).normalized()));
    CHECK(along > std::cos(radians(1.01)));
  }
  // What a keyframe has seen of the Manhattan frame is of the one in common, and exact.
  for (std::size_t k : {0, 7}) {
    const SO3<double> in_common = SO3<double>::exp({0, radians(90.0), 0});
    const auto& seen = map.keyframes[6 + k].manhattan->cam_from_world;
    CHECK(angle_between(seen * in_common, moved.keyframes[k].manhattan->cam_from_world) < 1e-9);
  }
  // Ids of erased landmarks are given away again.
  const auto dead =
      std::count_if(map.points.begin(), map.points.end(), [](const auto& p) { return !p.alive; });
  REQUIRE(dead > 0);
  const std::size_t size = map.points.size();
  map.add_point({1, 2, 3}, 0);
  CHECK(map.points.size() == size);
}
