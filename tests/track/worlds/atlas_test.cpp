// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/worlds/atlas.hpp"

#include <set>

#include "support/catch.hpp"

namespace {

using namespace sslam;

World<double> world_of(int number, int frames) {
  World<double> world;
  world.number = number;
  world.map.add_keyframe({});
  for (int i = 0; i < frames; ++i) world.log.add(world.map, i, 0.1 * i, 0, {});
  return world;
}

}  // namespace

TEST_CASE("The atlas asks for each of its worlds in turn and knows the largest") {
  Atlas<double> atlas;
  CHECK(atlas.next() == nullptr);
  CHECK(atlas.largest() == nullptr);
  for (const int frames : {20, 50, 30}) atlas.lay_aside(world_of(frames, frames));
  REQUIRE(atlas.largest()->number == 50);
  const int first = atlas.next()->number;
  const int second = atlas.next()->number;
  const int third = atlas.next()->number;
  CHECK(std::set{first, second, third} == std::set{20, 30, 50});
  CHECK(atlas.next()->number == first);
  CHECK(atlas.take(*atlas.largest()).number == 50);
  CHECK(atlas.worlds().size() == 2);
  CHECK(atlas.largest()->number == 30);
}

TEST_CASE("The smallest world makes room for one more") {
  Atlas<double> atlas;
  atlas.options.most = 2;
  for (const int frames : {20, 10, 30}) atlas.lay_aside(world_of(frames, frames));
  REQUIRE(atlas.worlds().size() == 2);
  CHECK(atlas.worlds()[0].number == 20);
  CHECK(atlas.worlds()[1].number == 30);
}
