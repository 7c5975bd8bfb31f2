// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/core/descriptor.hpp"

#include "sslam/core/random.hpp"
#include "support/catch.hpp"

TEST_CASE("The Hamming distance counts the bits that differ, from none to all") {
  using sslam::Descriptor, sslam::hamming;
  static_assert(hamming(Descriptor{}, Descriptor{}) == 0);
  static_assert(hamming(Descriptor{}, Descriptor{{~0ULL, ~0ULL, ~0ULL, ~0ULL}}) == 256);
  sslam::Random random(7);
  for (int round = 0; round < 100; ++round) {
    Descriptor a, b;
    for (auto& word : a.words) word = random.next();
    for (auto& word : b.words) word = random.next() & random.next();
    int differ = 0;
    for (std::size_t i = 0; i < 256; ++i)
      differ += (a.words[i / 64] >> i % 64 & 1) != (b.words[i / 64] >> i % 64 & 1);
    REQUIRE(hamming(a, b) == differ);
    REQUIRE(hamming(b, a) == differ);
  }
}
