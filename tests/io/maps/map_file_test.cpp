// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/io/maps/map_file.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <thread>
#include <type_traits>

#include "io/errors.hpp"
#include "sslam/core/random.hpp"
#include "support/catch.hpp"
#include "support/map_scene.hpp"
#include "support/scratch_folder.hpp"

namespace {

using namespace sslam;
using namespace sslam::testing;
using io::ByteWriter;
using io::FieldRange;

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

// Writes a map but for one field, to which it gives a value that the field cannot have.
struct SpoilingWriter {
  static constexpr bool kReads = false;
  ByteWriter bytes;
  std::string spoiled;                    // name of the field
  int bad = 0;                            // which of the bad values
  std::map<std::string, int> bad_values;  // of each field that was met: how many there are

  template <class T>
  void operator()(const T& value, const FieldRange<T>& range) {
    std::vector<T> values;
    using Limits = std::numeric_limits<T>;
    if constexpr (std::is_floating_point_v<T>)
      values = {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), Limits::max(),
                Limits::lowest()};
    else
      values = {Limits::max(), Limits::min()};
    std::erase_if(values, [&](T v) { return !std::is_floating_point_v<T> && v == 0; });
    const bool first = bad_values.emplace(range.name, static_cast<int>(values.size())).second;
    bytes(first && spoiled == range.name ? values[static_cast<std::size_t>(bad)] : value);
  }
};

void write_payload(const std::filesystem::path& path, const std::string& payload) {
  ByteWriter head;
  head(std::uint32_t{2});
  head(std::uint64_t{payload.size()});
  head(io::checksum(payload));
  io::write_text(path, "SSLAMMAP" + head.bytes + payload);
}

}  // namespace

TEST_CASE("Each field of a map file has a range, and is refused beyond it") {
  const ScratchFolder folder;
  const auto path = folder.path() / "a.sslam";
  Map<double> map = room_map();
  map.keyframes[0].line_axes.assign(map.keyframes[0].frame.lines.size(), std::int8_t{2});
  const auto write = [&](const std::string& spoiled, int bad) {
    SpoilingWriter writer;
    writer.spoiled = spoiled;
    writer.bad = bad;
    io::MapFields(writer).walk(map);
    write_payload(path, writer.bytes.bytes);
    return writer.bad_values;
  };
  const auto fields = write("", 0);
  REQUIRE_NOTHROW(io::load_map(path));
  REQUIRE(fields.size() > 40);
  for (const auto& [name, count] : fields) {
    if (name == "a descriptor") continue;  // bits, of which all mean something
    for (int bad = 0; bad < count; ++bad) {
      (void)write(name, bad);
      const std::string why = error_of([&] { (void)io::load_map(path); });
      INFO(name << ", bad value " << bad << ": " << why);
      REQUIRE(contains(why, "a.sslam: " + name + " is "));
      REQUIRE(contains(why, "; expected "));
      REQUIRE(is_one_line(why));
    }
  }
}

TEST_CASE("A map file whose bytes are changed is refused or taken, and nothing else") {
  const ScratchFolder folder;
  const auto path = folder.path() / "a.sslam";
  ByteWriter payload;
  Map<double> map = room_map();
  io::MapFields(payload).walk(map);
  Random random(7);
  for (int round = 0; round < 300; ++round) {
    std::string bytes = payload.bytes;
    for (int change = 0; change < 3; ++change)
      bytes[random.below(static_cast<std::uint32_t>(bytes.size()))] = static_cast<char>(random.below(256));
    if (round % 3 == 0) bytes.resize(random.below(static_cast<std::uint32_t>(bytes.size())));
    write_payload(path, bytes);
    std::size_t keyframes = 0;
    const std::string why = error_of([&] { keyframes = io::load_map(path).keyframes.size(); });
    REQUIRE((keyframes > 0 || is_one_line(why)));
  }
}

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
  // An observation of which the keyframe knows nothing, and one of which the landmark does not; the same
  // twice.
  refused([&](auto& m) { MapDoor::open(seen(m).observations)[0].feature += 1; });
  refused([&](auto& m) { MapDoor::open(seen(m).observations).pop_back(); });
  refused([&](auto& m) { MapDoor::open(seen(m).observations).push_back(seen(m).observations[0]); });
  refused([](auto& m) {
    auto& named = MapDoor::open(m.keyframes[3].line_landmarks);
    *std::find_if(named.begin(), named.end(), [](LandmarkId id) { return id != kNone; }) = kNone;
  });
  refused([&](auto& m) { seen(m).position.x() = std::nan(""); });
  refused([](auto& m) { m.keyframes[3].parent = 4; });  // a ring: 4 went to 3
  refused([](auto& m) { m.keyframes[0].parent = 1; });
  refused([](auto& m) { m.lines[0].axis = 9; });
  refused([](auto& m) { m.planes[0].axis = 3; });
  refused([](auto& m) { m.planes[0].plane.normal *= 2; });
  refused([](auto& m) { m.planes[0].plane.distance = std::nan(""); });
  refused([](auto& m) { m.planes[0].alive = false; });  // and has members
  refused([](auto& m) { m.lines[0].plane = 1; });
  refused([](auto& m) { m.lines[0].line.direction.setZero(); });
  refused([](auto& m) { m.lines[0].first_keyframe = 9; });
  refused([](auto& m) { m.keyframes[3].neighbours.at(0).keyframe = 4; });  // which is gone
  refused([](auto& m) { m.keyframes[3].neighbours.at(0).keyframe = 3; });
  refused([](auto& m) { m = {}; });
}

TEST_CASE("A map file without an end is refused at its first bytes") {
  CHECK(sslam::testing::error_of([] { (void)sslam::io::load_map("/dev/zero"); }).find("is no map") !=
        std::string::npos);
}

TEST_CASE("A map is read from a pipe as from its file") {
  const ScratchFolder folder;
  const auto file = folder.path() / "a.sslam", pipe = folder.path() / "pipe";
  io::save_map(file, room_map());
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << text_of(file); });
  CHECK(io::load_map(pipe).points.size() == room_map().points.size());
  writer.join();
}
