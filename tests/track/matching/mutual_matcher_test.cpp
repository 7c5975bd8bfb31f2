// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/track/matching/mutual_matcher.hpp"

#include <initializer_list>

#include "support/catch.hpp"

using namespace sslam;

namespace {

using Points = std::vector<PointFeature<double>>;

// Each point's descriptor has that many bits set, from the first on: the distance of two is the difference.
Points points_with(std::initializer_list<int> bits) {
  Points points;
  for (const int count : bits) {
    PointFeature<double>& point = points.emplace_back();
    for (int i = 0; i < count; ++i)
      point.descriptor.words[static_cast<std::size_t>(i / 64)] |= 1ULL << i % 64;
  }
  return points;
}

const auto all_of = [](const Points& b) {
  return [&b](std::int32_t, auto visit) {
    for (std::size_t j = 0; j < b.size(); ++j) visit(static_cast<std::int32_t>(j));
  };
};

bool has(const std::vector<IndexPair>& pairs, std::int32_t first, std::int32_t second) {
  for (const IndexPair& p : pairs)
    if (p.first == first && p.second == second) return true;
  return false;
}

}  // namespace

TEST_CASE("Features that look alike become pairs, in whatever order they come") {
  const Points a = points_with({0, 100, 200}), b = points_with({205, 3, 90});
  std::vector<IndexPair> pairs;
  MutualMatcher().match(a, b, PointMatchOptions<double>{}, all_of(b), pairs);
  CHECK(pairs.size() == 3);
  CHECK(has(pairs, 0, 1));
  CHECK(has(pairs, 1, 2));
  CHECK(has(pairs, 2, 0));
}

TEST_CASE("A feature that two want goes to the nearer one, and the other has none") {
  const Points a = points_with({10, 14}), b = points_with({13, 200});
  std::vector<IndexPair> pairs;
  MutualMatcher().match(a, b, PointMatchOptions<double>{}, all_of(b), pairs);
  REQUIRE(pairs.size() == 1);
  CHECK(has(pairs, 1, 0));
}

TEST_CASE("What differs too much, or looks like two, is not matched") {
  std::vector<IndexPair> pairs{{7, 7}};
  const Points a = points_with({0}), far = points_with({65}), twins = points_with({20, 21});
  MutualMatcher matcher;
  matcher.match(a, far, PointMatchOptions<double>{.max_distance = 64}, all_of(far), pairs);
  CHECK(pairs.empty());
  matcher.match(a, far, PointMatchOptions<double>{.max_distance = 65}, all_of(far), pairs);
  CHECK(pairs.size() == 1);
  matcher.match(a, twins, PointMatchOptions<double>{}, all_of(twins), pairs);
  CHECK(pairs.empty());
}

TEST_CASE("Only candidates are matched") {
  const Points a = points_with({0, 50}), b = points_with({0, 50});
  std::vector<IndexPair> pairs;
  const auto crosswise = [](std::int32_t i, auto visit) { visit(1 - i); };
  MutualMatcher().match(a, b, PointMatchOptions<double>{.max_distance = 64}, crosswise, pairs);
  CHECK(pairs.size() == 2);
  CHECK(has(pairs, 0, 1));
  CHECK(has(pairs, 1, 0));
}

TEST_CASE("Pairs that turn otherwise than most are dropped") {
  Points a(40), b(40);
  std::vector<IndexPair> pairs;
  for (std::int32_t i = 0; i < 40; ++i) {
    const bool odd = i >= 38;
    b[static_cast<std::size_t>(i)].angle = odd ? 2.5 : 0.3;
    pairs.push_back({i, i});
  }
  keep_consistent_rotation<double>(a, b, pairs);
  CHECK(pairs.size() == 38);
  CHECK(!has(pairs, 39, 39));
}
