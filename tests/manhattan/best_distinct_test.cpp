// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/manhattan/best_distinct.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "support/catch.hpp"

namespace best_distinct_test {

// Numbers that differ by less than one are the same.
struct Near {
  bool operator()(double a, double b) const noexcept { return std::abs(a - b) < 1; }
};
using Best = sslam::BestDistinct<double, double, 3, Near>;

// Items and scores, best first.
std::vector<std::pair<double, double>> sorted(const Best& best) {
  std::vector<std::pair<double, double>> all;
  for (std::size_t i = 0; i < best.size(); ++i) all.emplace_back(best[i].score, best[i].item);
  std::sort(all.rbegin(), all.rend());
  return all;
}

using Entries = std::vector<std::pair<double, double>>;

}  // namespace best_distinct_test

TEST_CASE("Of items that are the same the best one stays, of others the best few") {
  using namespace best_distinct_test;
  Best best{Near{}};
  best.offer(0, 5);
  best.offer(0.5, 4);  // the same as 0, and worse
  CHECK(sorted(best) == Entries{{5, 0}});
  best.offer(0.6, 7);  // the same as 0, and better
  CHECK(sorted(best) == Entries{{7, 0.6}});
  best.offer(10, 3);
  best.offer(20, 9);
  CHECK(best[best.best()].item == 20);
  best.offer(30, 3);  // full, and no better than the worst
  CHECK(sorted(best) == Entries{{9, 20}, {7, 0.6}, {3, 10}});
  best.offer(30, 4);
  CHECK(sorted(best) == Entries{{9, 20}, {7, 0.6}, {4, 30}});
  best.offer(20.5, 8);  // full, and the same as a better one
  CHECK(sorted(best) == Entries{{9, 20}, {7, 0.6}, {4, 30}});
}

TEST_CASE("The second best is not the best, and nothing where there is none") {
  using namespace best_distinct_test;
  Best best{Near{}};
  CHECK(best.second_best_score() == 0);
  best.offer(0, 5);
  CHECK(best.second_best_score() == 0);
  best.offer(10, -2);
  CHECK(best.second_best_score() == 0);
  best.offer(20, 8);
  CHECK(best.second_best_score() == 5);
  CHECK(best[best.best()].score == 8);
}
