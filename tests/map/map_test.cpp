// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/map/map.hpp"

#include <type_traits>
#include <utility>
#include <vector>

#include "sslam/map/local_map.hpp"
#include "support/catch.hpp"

namespace {

using namespace sslam;

// A keyframe with `features` point features, none of them matched.
Keyframe<double> bare_keyframe(std::size_t features) {
  Keyframe<double> kf;
  kf.frame.points.resize(features);
  for (auto& p : kf.frame.points) p.pixel.setZero();
  return std::move(kf).seeing(std::vector<LandmarkId>(features, kNone), {});
}

// Three keyframes; point 0 is seen by all, point 1 by the first two.
Map<double> small_map() {
  Map<double> map;
  for (int k = 0; k < 3; ++k) map.add_keyframe(bare_keyframe(4));
  map.add_point({0, 0, 5}, 0);
  map.add_point({1, 0, 5}, 0);
  for (KeyframeId k = 0; k < 3; ++k) map.observe_point(0, k, 0);
  for (KeyframeId k = 0; k < 2; ++k) map.observe_point(1, k, 1);
  for (KeyframeId k = 0; k < 3; ++k) map.update_covisibility(k);
  return map;
}

// What two lists of the map say about one observation cannot be changed in one of them alone.
static_assert(!std::is_copy_assignable_v<MapList<LandmarkId>> &&
              !std::is_move_assignable_v<MapList<LandmarkId>>);
static_assert(std::is_copy_assignable_v<Keyframe<double>> &&
              std::is_copy_assignable_v<PointLandmark<double>>);

}  // namespace

TEST_CASE("Covisibility counts shared landmarks and is the same from both sides") {
  const Map<double> map = small_map();
  REQUIRE(map.keyframes[0].neighbours.size() == 2);
  REQUIRE(map.keyframes[0].neighbours[0].keyframe == 1);
  REQUIRE(map.keyframes[0].neighbours[0].shared == 2);
  REQUIRE(map.keyframes[2].neighbours.size() == 2);
  REQUIRE(map.keyframes[2].neighbours[0].shared == 1);
}

TEST_CASE("Erasing a landmark frees the features that saw it") {
  Map<double> map = small_map();
  map.erase_point(0);
  REQUIRE_FALSE(map.points[0].alive);
  for (const auto& kf : map.keyframes) REQUIRE(kf.point_landmarks[0] == kNone);
  REQUIRE(map.keyframes[0].point_landmarks[1] == 1);
}

TEST_CASE("The id of an erased landmark serves again") {
  Map<double> map = small_map();
  const std::size_t points = map.points.size();
  map.erase_point(1);
  map.erase_point(1);  // no more than once
  REQUIRE(map.add_point({1, 2, 3}, 2) == 1);
  REQUIRE(map.points[1].alive);
  REQUIRE(map.points[1].observations.empty());
  REQUIRE(map.points[1].first_keyframe == 2);
  REQUIRE(map.add_point({1, 2, 4}, 2) == static_cast<LandmarkId>(points));
}

TEST_CASE("A landmark that only one keyframe sees any more is erased") {
  Map<double> map = small_map();
  map.forget_point(1, 0);
  REQUIRE_FALSE(map.points[1].alive);
  REQUIRE(map.keyframes[1].point_landmarks[1] == kNone);
  map.forget_point(0, 2);
  REQUIRE(map.points[0].alive);
  REQUIRE(map.points[0].observations.size() == 2);
}

TEST_CASE("Fusion hands observations over and keeps one for each keyframe") {
  Map<double> map = small_map();
  map.add_point({0, 0, 5}, 2);
  map.observe_point(2, 2, 3);
  map.observe_point(2, 1, 3);
  map.fuse_points(2, 1);
  REQUIRE_FALSE(map.points[2].alive);
  REQUIRE(map.points[1].observations.size() == 3);
  REQUIRE(map.keyframes[2].point_landmarks[3] == 1);
  REQUIRE(map.keyframes[1].point_landmarks[3] == kNone);  // keyframe 1 saw point 1 already, by feature 1
}

TEST_CASE("A keyframe that joins with matches enters them and drops dead ones") {
  Map<double> map = small_map();
  map.erase_point(1);
  const KeyframeId id = map.add_keyframe(bare_keyframe(4).seeing({0, 1, kNone, kNone}, {}));
  REQUIRE(map.points[0].observations.back().keyframe == id);
  REQUIRE(map.keyframes[map.index(id)].point_landmarks[1] == kNone);
}

TEST_CASE("A keyframe that is erased leaves its place to its parent and nothing else") {
  Map<double> map = small_map();
  for (int k = 0; k < 3; ++k) map.keyframes[map.index(k)].cam_from_world.translation.x() = k;
  map.erase_keyframe(1, 2);
  REQUIRE_FALSE(map.keyframes[1].alive());
  REQUIRE(map.keyframes[1].frame.points.empty());
  REQUIRE(map.points[0].observations.size() == 2);
  REQUIRE_FALSE(map.points[1].alive);  // a single keyframe saw it any more
  REQUIRE(map.keyframes[0].neighbours.size() == 1);
  REQUIRE(map.keyframes[0].neighbours[0].keyframe == 2);
  REQUIRE(map.pose(1).translation.x() == Approx(1));
  map.keyframes[2].cam_from_world.translation.x() += 5;
  REQUIRE(map.pose(1).translation.x() == Approx(6));
  map.erase_keyframe(2, 0);
  REQUIRE(map.pose(1).translation.x() == Approx(6));
  map.keyframes[0].cam_from_world.translation.x() -= 3;
  REQUIRE(map.pose(1).translation.x() == Approx(3));
}

TEST_CASE("A map that is renewed is the later one, and keeps the features that it has") {
  Map<double> map = small_map(), earlier = map;
  const auto* features = earlier.keyframes[0].frame.points.data();
  map.add_keyframe(bare_keyframe(3));
  map.observe_point(1, 3, 2);
  map.update_covisibility(3);
  map.erase_keyframe(2, 1);
  map.erase_point(0);
  map.points[1].position.x() = 7;
  map.keyframes[0].cam_from_world.translation.x() = 2;
  map.lay_point(1, map.add_plane({Vec3<double>::UnitX(), 7}, kNone));
  earlier.renew_from(map);
  REQUIRE(earlier.keyframes.size() == 4);
  CHECK(earlier.keyframes[0].frame.points.data() == features);
  CHECK(earlier.keyframes[0].cam_from_world.translation.x() == 2);
  CHECK(earlier.keyframes[3].frame.points.size() == 3);
  CHECK(earlier.keyframes[3].point_landmarks == map.keyframes[3].point_landmarks.values());
  CHECK(earlier.keyframes[0].neighbours.size() == map.keyframes[0].neighbours.size());
  CHECK_FALSE(earlier.keyframes[2].alive());
  CHECK(earlier.keyframes[2].frame.points.empty());
  CHECK(earlier.points[1].position.x() == 7);
  CHECK(earlier.points[1].observations.size() == 3);
  CHECK(earlier.members(0).points == std::vector<LandmarkId>{1});
  CHECK(earlier.add_point({0, 0, 1}, 3) == 0);  // free there, free here
}

TEST_CASE("A plane knows its members, however they came to it") {
  Map<double> map = small_map();
  const LandmarkId plane = map.add_plane({Vec3<double>::UnitZ(), 5}, kNone);
  const LandmarkId other = map.add_plane({Vec3<double>::UnitZ(), 6}, kNone);
  CHECK(map.members(plane).size() == 0);
  map.lay_point(1, plane);
  map.lay_point(0, plane);
  CHECK(map.members(plane).points == std::vector<LandmarkId>{0, 1});
  map.move_members(plane, other);
  CHECK(map.members(plane).size() == 0);
  CHECK(map.points[0].plane == other);
  map.fuse_points(0, 1);
  CHECK(map.members(other).points == std::vector<LandmarkId>{1});
  const Map<double> copy = map;
  CHECK(copy.members(other).points == std::vector<LandmarkId>{1});
  map.erase_plane(other);
  CHECK(map.points[1].plane == kNone);
  CHECK(map.members(other).size() == 0);
}

TEST_CASE("The local map lists each landmark once and keyframes by what they share") {
  const Map<double> map = small_map();
  LocalMap<double> local;
  const std::vector<LandmarkId> points{kNone, 1};
  local.gather(map, points, {}, 10);
  REQUIRE(local.keyframes.size() == 3);
  REQUIRE(local.keyframes.back() == 2);  // a neighbour that does not see point 1 itself
  REQUIRE(local.points.size() == 2);
  local.gather(map, points, {}, 2);
  REQUIRE(local.keyframes.size() == 2);
}
