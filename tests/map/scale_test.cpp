// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <vector>

#include "sslam/map/depth_ratios.hpp"
#include "sslam/map/floor.hpp"
#include "sslam/map/rescale.hpp"
#include "support/catch.hpp"
#include "support/map_errors.hpp"

namespace scale_test {
namespace {

using namespace sslam;
using namespace sslam::testing;

// Of a room with its floor 1.2 m below the path, in a unit of 0.4 m.
constexpr double kMetres = 0.4, kHeight = 1.2;

MapScene make_scene() {
  return MapScene({.half = {4, kHeight, 3}, .points = 1500, .lines = 150}, sweep(12, 0.25));
}

// Turned, so that no axis of the world is the vertical.
Map<double> turned(Map<double> map, const SE3<double>& new_from_old) {
  const Sim3<double> moved = similarity(new_from_old);
  for (auto& kf : map.keyframes) kf.cam_from_world = kf.cam_from_world * new_from_old.inverse();
  for (auto& point : map.points) point.position = moved * point.position;
  for (auto& line : map.lines) {
    line.line = transform(moved, line.line);
    line.start = moved * line.start;
    line.end = moved * line.end;
  }
  for (auto& axes : map.world_from_manhattan) axes = new_from_old.rotation * axes;
  return map;
}

const SE3<double> kTurn{SO3<double>::exp({0.5, -0.9, 0.3}), {1, 2, 3}};

}  // namespace

TEST_CASE("A map in another unit looks the same from every keyframe") {
  MapScene scene = make_scene();
  const Map<double> before = scene.make_map();
  Map<double> after = before;
  rescale(after, 2.5);
  for (std::size_t k = 0; k < before.keyframes.size(); ++k) {
    const SE3<double>&a = before.keyframes[k].cam_from_world, &b = after.keyframes[k].cam_from_world;
    REQUIRE((b.inverse().translation - 2.5 * a.inverse().translation).norm() < 1e-12);
    for (std::size_t i = 0; i < before.points.size(); ++i) {
      const Vec3<double> x = a * before.points[i].position, y = b * after.points[i].position;
      REQUIRE((y - 2.5 * x).norm() < 1e-9);
    }
    for (std::size_t i = 0; i < before.lines.size(); ++i) {
      const auto& l = before.keyframes[k].frame.pinhole;
      const Vec3<double> x = project_line(l, transform(a, before.lines[i].line));
      const Vec3<double> y = project_line(l, transform(b, after.lines[i].line));
      REQUIRE((x - y).norm() < 1e-6 * (1 + x.norm()));
      REQUIRE((after.lines[i].start - 2.5 * before.lines[i].start).norm() < 1e-12);
    }
  }
}

TEST_CASE("Ratios of measured depth tell the unit of a map, with a third of the measurements wrong") {
  MapScene scene = make_scene();
  Map<double> map = scene.make_map();
  Map<double> small = map;
  rescale(small, 1 / kMetres);
  std::vector<double> medians;
  int row = 0;
  for (const Keyframe<double>& kf : small.keyframes) {
    // The true depth of the landmark that is seen there.
    const auto depth_at = [&](const Vec2<double>& pixel) {
      for (std::size_t i = 0; i < kf.frame.points.size(); ++i)
        if (kf.frame.points[i].pixel == pixel && kf.point_landmarks[i] != kNone) {
          const auto id = map.index(kf.point_landmarks[i]);
          const double z = (map.keyframes[map.index(kf.id)].cam_from_world * map.points[id].position).z();
          return ++row % 3 == 0 ? 3 * z : row % 7 == 0 ? 0 : z;
        }
      return 0.0;
    };
    std::vector<double> ratios = depth_ratios<double>(small, kf, depth_at);
    REQUIRE(ratios.size() > 10);
    medians.push_back(median<double>(ratios));
  }
  const CommonRatio<double> common = common_ratio<double>(medians);
  CHECK(common.value == Approx(kMetres).epsilon(1e-6));
  CHECK(common.spread < 1e-6);
}

TEST_CASE("The floor is found along the Manhattan frame's vertical, whatever the world's axes") {
  MapScene scene = make_scene();
  Map<double> map = turned(scene.make_map(), kTurn);
  rescale(map, 1 / kMetres);
  const Floor<double> floor = find_floor(map);
  REQUIRE(floor.status == FloorStatus::kFound);
  CHECK(floor.camera_height * kMetres == Approx(kHeight).epsilon(0.03));
  CHECK(floor.support >= 20);
  CHECK(floor.spread < 0.2);
  const Vec3<double> up = kTurn.rotation * Vec3<double>(0, -1, 0);
  CHECK(floor.plane.normal.dot(up) > std::cos(radians(0.5)));
  CHECK(floor.plane.offset(map.keyframes.front().cam_from_world.inverse().translation) > 0);
}

TEST_CASE("Without a Manhattan frame the floor's own points say which way is down") {
  MapScene scene = make_scene();
  Map<double> map = turned(scene.make_map(), kTurn);
  map.world_from_manhattan.clear();
  const Floor<double> floor = find_floor(map);
  REQUIRE(floor.status == FloorStatus::kFound);
  CHECK(floor.camera_height == Approx(kHeight).epsilon(0.05));
}

TEST_CASE("A floor whose landmarks scatter by a tenth of its depth is found, and at its depth") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    MapScene scene = make_scene();
    Map<double> map = scene.make_map();
    Random random(seed);
    for (auto& point : map.points) {
      const double a = random.uniform(-0.05, 0.05), b = random.uniform(-0.05, 0.05);
      const double c = random.uniform(-0.05, 0.05);
      if (point.alive && std::abs(point.position.y()) == kHeight) point.position.y() *= 1 + a + b + c;
    }
    const Floor<double> floor = find_floor(map);
    REQUIRE(floor.status == FloorStatus::kFound);
    CHECK(floor.camera_height == Approx(kHeight).epsilon(0.05));
  }
}

TEST_CASE("A table is not the floor under it") {
  MapScene scene = make_scene();
  Map<double> map = scene.make_map();
  Random random(5);
  for (int i = 0; i < 400; ++i)
    map.add_point({random.uniform(-1.0, 1.0), kHeight - 0.5, random.uniform(-1.0, 1.0)}, 0);
  const Floor<double> floor = find_floor(map);
  REQUIRE(floor.status == FloorStatus::kFound);
  CHECK(floor.camera_height == Approx(kHeight).epsilon(0.03));
}

TEST_CASE("Walls alone are no floor, and rolled cameras know no down") {
  MapScene scene = make_scene();
  Map<double> map = scene.make_map();
  for (std::size_t i = 0; i < map.points.size(); ++i)
    if (map.points[i].alive && std::abs(map.points[i].position.y()) == kHeight)
      map.erase_point(static_cast<LandmarkId>(i));
  for (std::size_t i = 0; i < map.lines.size(); ++i)
    if (map.lines[i].alive) map.erase_line(static_cast<LandmarkId>(i));
  CHECK(find_floor(map).status == FloorStatus::kNoLayer);

  Map<double> rolled = scene.make_map();
  for (std::size_t k = 0; k < rolled.keyframes.size(); ++k) {
    SE3<double>& pose = rolled.keyframes[k].cam_from_world;
    pose = SE3<double>{SO3<double>::exp({0, 0, 1.57 * static_cast<double>(k)}), Vec3<double>::Zero()} * pose;
  }
  CHECK(find_floor(rolled).status == FloorStatus::kNoVertical);
  CHECK(find_floor(Map<double>()).status == FloorStatus::kNoVertical);
}

}  // namespace scale_test
