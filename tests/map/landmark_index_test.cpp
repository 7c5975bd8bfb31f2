// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/map/landmark_index.hpp"

#include <cstdint>
#include <vector>

#include "support/catch.hpp"

namespace landmark_index_test {

using namespace sslam;
using Points = std::vector<PointLandmark<double>>;

Descriptor filled(std::uint64_t word) {
  Descriptor d;
  d.words.fill(word);
  return d;
}

// Each landmark that differs from the descriptor in no bit.
std::vector<LandmarkId> exact(const LookIndex& looks, const Descriptor& descriptor) {
  std::vector<LandmarkId> found;
  looks.near(descriptor, 0, [&](LandmarkId id, int) { found.push_back(id); });
  return found;
}

struct Indexed {
  Points points;
  LandmarkIndex index;

  LandmarkId add(std::uint64_t word) {
    const LandmarkId id = index.settle(points, new_point_landmark(Vec3<double>(0, 0, 1), 0));
    index.look_like(points, id, filled(word));
    return id;
  }
};

}  // namespace landmark_index_test

TEST_CASE("A landmark that is buried is dead, looks like nothing, and leaves its id to the next") {
  using namespace landmark_index_test;
  Indexed x;
  for (const std::uint64_t word : {1, 2, 3}) x.add(word);
  REQUIRE(exact(x.index.looks(x.points), filled(2)) == std::vector<LandmarkId>{1});
  x.index.bury(x.points, 1);
  CHECK_FALSE(x.points[1].alive);
  CHECK(exact(x.index.looks(x.points), filled(2)).empty());
  CHECK(x.add(9) == 1);
  CHECK(x.points[1].alive);
  CHECK(x.points[1].descriptor.words == filled(9).words);
  CHECK(exact(x.index.looks(x.points), filled(9)) == std::vector<LandmarkId>{1});
  CHECK(x.add(4) == 3);
}

TEST_CASE("Landmarks that look alike from now on are found by their new look alone") {
  using namespace landmark_index_test;
  Indexed x;
  for (const std::uint64_t word : {1, 2}) x.add(word);
  REQUIRE(exact(x.index.looks(x.points), filled(1)) == std::vector<LandmarkId>{0});
  x.index.look_like(x.points, 0, filled(2));
  CHECK(exact(x.index.looks(x.points), filled(1)).empty());
  CHECK(exact(x.index.looks(x.points), filled(2)).size() == 2);
}

TEST_CASE("Landmarks from outside are collected: the dead ones' ids are free, the others are found") {
  using namespace landmark_index_test;
  Indexed x;
  for (const std::uint64_t word : {1, 2, 3}) x.add(word);
  REQUIRE(exact(x.index.looks(x.points), filled(1)).size() == 1);
  Points others = x.points;
  others[0].alive = false;
  others[2].descriptor = filled(7);
  x.points = others;
  x.index.collect(x.points);
  CHECK(exact(x.index.looks(x.points), filled(1)).empty());
  CHECK(exact(x.index.looks(x.points), filled(3)).empty());
  CHECK(exact(x.index.looks(x.points), filled(7)) == std::vector<LandmarkId>{2});
  CHECK(x.add(5) == 0);
}

TEST_CASE("A copy of the index has the same free ids, and finds the landmarks of its own list") {
  using namespace landmark_index_test;
  Indexed x;
  for (const std::uint64_t word : {1, 2}) x.add(word);
  x.index.bury(x.points, 0);
  REQUIRE(exact(x.index.looks(x.points), filled(2)).size() == 1);
  Indexed copy = x;
  CHECK(copy.add(3) == 0);
  CHECK(exact(copy.index.looks(copy.points), filled(3)) == std::vector<LandmarkId>{0});
  CHECK(exact(copy.index.looks(copy.points), filled(2)) == std::vector<LandmarkId>{1});
  CHECK(exact(x.index.looks(x.points), filled(3)).empty());
}
