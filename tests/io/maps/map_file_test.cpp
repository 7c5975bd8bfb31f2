// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/io/maps/map_file.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"
#include "support/catch.hpp"
#include "support/map_scene.hpp"
#include "support/scratch_folder.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;

Map<double> room_map() {
  MapSceneOptions options;
  options.points = 120;
  options.lines = 40;
  std::vector<SE3<double>> path;
  for (int k = 0; k < 9; ++k) path.push_back(look({0.1 * k, 0, -2}, 0.05 * k, 0));
  Map<double> map = MapScene(options, path).make_map();
  map.erase_keyframe(4, 3);
  map.erase_point(2);
  const LandmarkId wall = map.add_plane({{0, 0, 1}, 3}, 2);
  for (auto& p : map.points)
    if (p.alive && p.position.z() == 3) p.plane = wall;
  map.world_from_manhattan = {SO3<double>::exp({0.1, -0.2, 0.3})};
  return map;
}

}  // namespace

TEST_CASE("A map comes back from its file as it was") {
  const ScratchFolder folder;
  const Map<double> map = room_map();
  io::save_map(folder.path() / "a.sslam", map);
  const Map<double> again = io::load_map(folder.path() / "a.sslam");
  REQUIRE(again.keyframes.size() == 9);
  REQUIRE_FALSE(again.keyframes[4].alive());
  REQUIRE((again.pose(4).inverse().translation - map.pose(4).inverse().translation).norm() < 1e-12);
  REQUIRE(again.points.size() == map.points.size());
  REQUIRE_FALSE(again.points[2].alive);
  REQUIRE(again.keyframes[1].frame.points[5].descriptor == map.keyframes[1].frame.points[5].descriptor);
  REQUIRE(again.keyframes[1].neighbours.size() == map.keyframes[1].neighbours.size());
  REQUIRE(again.keyframes[2].manhattan->covariance == map.keyframes[2].manhattan->covariance);
  REQUIRE(angle_between(again.world_from_manhattan.at(0), map.world_from_manhattan[0]) < 1e-12);
  REQUIRE(again.planes.size() == 1);
  REQUIRE(again.planes[0].plane.normal == map.planes[0].plane.normal);
  REQUIRE(again.planes[0].plane.distance == 3);
  REQUIRE(again.planes[0].axis == 2);
  for (std::size_t i = 0; i < map.points.size(); ++i) REQUIRE(again.points[i].plane == map.points[i].plane);
  for (std::size_t i = 0; i < map.lines.size(); ++i) {
    REQUIRE(again.lines[i].line.moment == map.lines[i].line.moment);
    REQUIRE(again.lines[i].observations.size() == map.lines[i].observations.size());
  }
}

TEST_CASE("A map file that is cut off or changed anywhere is refused") {
  const ScratchFolder folder;
  const auto path = folder.path() / "a.sslam";
  io::save_map(path, room_map());
  const std::string good = text_of(path);
  for (const std::size_t length : {good.size() - 1, good.size() / 2, std::size_t{29}, std::size_t{12}}) {
    folder.write("a.sslam", good.substr(0, length));
    REQUIRE_THROWS_AS(io::load_map(path), Error);
  }
  folder.write("a.sslam", good + "x");
  REQUIRE_THROWS_AS(io::load_map(path), Error);
  for (std::size_t at = 0; at < good.size(); at += good.size() / 97) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 16);
    folder.write("a.sslam", bad);
    INFO("byte " << at);
    REQUIRE_THROWS_AS(io::load_map(path), Error);
  }
}

TEST_CASE("What is wrong with a map file is said in one line with its name") {
  const ScratchFolder folder;
  const auto path = folder.path() / "a.sslam";
  const auto why = [&] { return error_of([&] { (void)io::load_map(path); }); };
  REQUIRE(contains(why(), "a.sslam: cannot read"));
  folder.write("a.sslam", "ply\n");
  REQUIRE(contains(why(), "a.sslam: is no map"));
  io::save_map(path, room_map());
  std::string other = text_of(path);
  other[8] = 7;
  folder.write("a.sslam", other);
  REQUIRE(contains(why(), "a.sslam: has version 7; this sslam reads version 2"));
  REQUIRE(is_one_line(why()));
}

TEST_CASE("A map that contradicts itself is refused however sound its file") {
  const ScratchFolder folder;
  const auto path = folder.path() / "a.sslam";
  const auto refused = [&](auto&& spoil) {
    Map<double> map = room_map();
    spoil(map);
    io::save_map(path, map);
    REQUIRE_THROWS_AS(io::load_map(path), Error);
  };
  refused([](auto& m) { MapDoor::open(m.keyframes[3].point_landmarks)[0] = 100000; });
  refused([](auto& m) { MapDoor::open(m.keyframes[3].point_landmarks).pop_back(); });
  const auto seen = [](auto& m) -> auto& {
    return *std::find_if(m.points.begin(), m.points.end(), [](auto& p) { return !p.observations.empty(); });
  };
  refused([&](auto& m) { MapDoor::open(seen(m).observations)[0].keyframe = -2; });
  refused([&](auto& m) { MapDoor::open(seen(m).observations)[0].feature = 100000; });
  refused([&](auto& m) { seen(m).position.x() = std::nan(""); });
  refused([](auto& m) { m.keyframes[3].parent = 4; });  // a ring: 4 went to 3
  refused([](auto& m) { m.keyframes[0].parent = 1; });
  refused([](auto& m) { m.lines[0].axis = 9; });
  refused([](auto& m) { m.planes[0].axis = 3; });
  refused([](auto& m) { m.planes[0].plane.normal *= 2; });
  refused([](auto& m) { m.planes[0].plane.distance = std::nan(""); });
  refused([](auto& m) { m.planes[0].alive = false; });  // and has members
  refused([](auto& m) { m.lines[0].plane = 1; });
  refused([](auto& m) { m = {}; });
}
