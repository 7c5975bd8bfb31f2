// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/map/bucket_lists.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sslam/core/random.hpp"
#include "support/catch.hpp"

using namespace sslam;

TEST_CASE("lists of buckets hold what was put in and not taken out") {
  constexpr std::size_t kBuckets = 5, kIds = 100;
  constexpr std::size_t kOut = kBuckets;
  BucketLists lists;
  CHECK(lists.empty());
  lists.assign(kBuckets);
  CHECK_FALSE(lists.empty());
  std::array<std::size_t, kIds> bucket;  // of each id
  bucket.fill(kOut);
  std::array<std::int32_t, kIds> slot{};
  Random random(5);
  for (int step = 0; step < 5000; ++step) {
    const std::size_t id = random.below(kIds);
    if (bucket[id] == kOut) {
      bucket[id] = random.below(kBuckets);
      slot[id] = lists.insert(bucket[id], static_cast<std::int32_t>(id));
    } else {
      const std::int32_t moved = lists.erase(bucket[id], slot[id]);
      if (moved != kNone) slot[static_cast<std::size_t>(moved)] = slot[id];
      bucket[id] = kOut;
    }
    if (step % 100 != 0) continue;
    for (std::size_t b = 0; b < kBuckets; ++b) {
      std::vector<std::int32_t> held, expected;
      lists.visit(b, [&](const BucketLists::Ids& ids, std::size_t count) {
        held.insert(held.end(), ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(count));
      });
      std::sort(held.begin(), held.end());
      for (std::size_t i = 0; i < kIds; ++i)
        if (bucket[i] == b) expected.push_back(static_cast<std::int32_t>(i));
      REQUIRE(held == expected);
    }
  }
}
