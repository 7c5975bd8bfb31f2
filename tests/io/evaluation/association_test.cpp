// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/io/evaluation/association.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "sslam/core/random.hpp"
#include "support/catch.hpp"

using namespace sslam;

namespace {

// The definition itself: all pairs, closest first, each entry once.
std::vector<io::StampPair> by_definition(const std::vector<double>& a, const std::vector<double>& b,
                                         double limit) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> all;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      if (std::abs(a[i] - b[j]) < limit) all.push_back({std::abs(a[i] - b[j]), i, j});
  std::sort(all.begin(), all.end());
  std::vector<bool> used_a(a.size()), used_b(b.size());
  std::vector<io::StampPair> pairs;
  for (const auto& [difference, i, j] : all) {
    if (used_a[i] || used_b[j]) continue;
    used_a[i] = used_b[j] = true;
    pairs.push_back({i, j});
  }
  std::sort(pairs.begin(), pairs.end(), [](auto& p, auto& q) { return p.a < q.a; });
  return pairs;
}

}  // namespace

TEST_CASE("The nearest stamp is found at the ends and between") {
  const std::vector<double> stamps{1, 2, 4};
  CHECK(io::nearest_stamp(stamps, 0) == 0);
  CHECK(io::nearest_stamp(stamps, 1.4) == 0);
  CHECK(io::nearest_stamp(stamps, 1.5) == 0);
  CHECK(io::nearest_stamp(stamps, 3.1) == 2);
  CHECK(io::nearest_stamp(stamps, 9) == 2);
}

TEST_CASE("Pairs by nearest stamp within the limit") {
  const std::vector<double> a{0.000, 0.033, 0.066, 5};
  const std::vector<double> b{0.001, 0.030, 0.060, 0.090};
  const auto pairs = io::associate(a, b, 0.02);
  REQUIRE(pairs.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(pairs[i].a == i);
    CHECK(pairs[i].b == i);
  }
  CHECK(io::associate({}, b, 0.02).empty());
  CHECK(io::associate(a, {}, 0.02).empty());
  CHECK(io::associate(std::vector<double>{0}, std::vector<double>{0.02}, 0.02).empty());
}

TEST_CASE("The closest pair wins and the loser takes its next") {
  const std::vector<double> a{0.00, 0.01};
  const std::vector<double> b{0.009, 0.02};
  const auto pairs = io::associate(a, b, 0.05);
  REQUIRE(pairs.size() == 2);
  CHECK(pairs[0].b == 1);
  CHECK(pairs[1].b == 0);
}

TEST_CASE("Association agrees with its definition on random stamps") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const auto draw = [&random](std::size_t count) {
      std::vector<double> stamps;
      for (std::size_t i = 0; i < count; ++i) stamps.push_back(random.uniform(0.0, 1.0));
      std::sort(stamps.begin(), stamps.end());
      return stamps;
    };
    const std::vector<double> a = draw(1 + random.below(25));
    const std::vector<double> b = draw(1 + random.below(25));
    const double limit = random.uniform(0.001, 0.4);
    const auto found = io::associate(a, b, limit);
    const auto expected = by_definition(a, b, limit);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      CHECK(found[i].a == expected[i].a);
      CHECK(found[i].b == expected[i].b);
    }
  }
}
