// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/image/corner_spreader.hpp"

#include <algorithm>
#include <array>

#include "sslam/core/random.hpp"
#include "support/catch.hpp"

using namespace sslam;

namespace {

constexpr int kSide = 100;

std::vector<Corner> random_corners(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Corner> corners;
  for (int i = 0; i < count; ++i)
    corners.push_back({random.uniform(0.0F, kSide - 1.0F), random.uniform(0.0F, kSide - 1.0F),
                       random.uniform(1.0F, 50.0F)});
  return corners;
}

bool equal(const std::vector<Corner>& a, const std::vector<Corner>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Corner& p, const Corner& q) {
    return p.x == q.x && p.y == q.y && p.score == q.score;
  });
}

}  // namespace

TEST_CASE("spreading keeps the budget and does not depend on the order") {
  std::vector<Corner> corners = random_corners(500, 1), reversed(corners.rbegin(), corners.rend());
  CornerSpreader spreader;
  SpreadOptions options;
  options.budget = 120;
  options.cell = 25;
  spreader.spread(corners, {kSide, kSide}, options);
  spreader.spread(reversed, {kSide, kSide}, options);
  CHECK(corners.size() == 120);
  CHECK(equal(corners, reversed));
}

TEST_CASE("cells share the budget evenly as far as they can") {
  std::vector<Corner> corners;
  for (int i = 0; i < 40; ++i) corners.push_back({10.0F + 0.1F * static_cast<float>(i), 10, 50});
  for (int i = 0; i < 3; ++i) corners.push_back({90, 80.0F + static_cast<float>(i), 5});
  CornerSpreader spreader;
  SpreadOptions options;
  options.cell = 50;
  options.budget = 12;
  spreader.spread(corners, {kSide, kSide}, options);
  CHECK(corners.size() == 12);
  CHECK(std::count_if(corners.begin(), corners.end(), [](const Corner& c) { return c.score == 5; }) == 3);
}

TEST_CASE("of two close corners the stronger stays") {
  std::vector<Corner> corners{{20, 20, 1}, {22, 21, 9}, {40, 40, 1}};
  CornerSpreader spreader;
  SpreadOptions options;
  options.min_distance = 3;
  spreader.spread(corners, {kSide, kSide}, options);
  REQUIRE(corners.size() == 2);
  CHECK(std::count_if(corners.begin(), corners.end(), [](const Corner& c) { return c.x == 20; }) == 0);
}

TEST_CASE("a cell uses the highest threshold that leaves it enough") {
  // Left cell: three strong and two weak corners; right cell: weak ones alone.
  std::vector<Corner> corners{{5, 5, 30},  {15, 5, 30}, {25, 5, 30}, {5, 25, 7},
                              {15, 25, 7}, {55, 5, 7},  {65, 5, 7}};
  constexpr std::array<float, 2> kThresholds{20, 5};
  CornerSpreader spreader;
  SpreadOptions options;
  options.cell = 50;
  options.thresholds = kThresholds;
  options.enough = 3;
  spreader.spread(corners, {kSide, kSide}, options);
  CHECK(std::count_if(corners.begin(), corners.end(), [](const Corner& c) { return c.x < 50; }) == 3);
  CHECK(std::count_if(corners.begin(), corners.end(), [](const Corner& c) { return c.x > 50; }) == 2);
}

TEST_CASE("no corners and no budget are fine") {
  CornerSpreader spreader;
  std::vector<Corner> none, some = random_corners(5, 2);
  SpreadOptions options;
  spreader.spread(none, {kSide, kSide}, options);
  CHECK(none.empty());
  options.budget = 0;
  spreader.spread(some, {kSide, kSide}, options);
  CHECK(some.empty());
}
