// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string>

#include "sslam/core/descriptor.hpp"
#include "sslam/core/inline_vector.hpp"
#include "sslam/core/random.hpp"
#include "sslam/core/status.hpp"
#include "support/catch.hpp"
#include "support/test_scalars.hpp"

using namespace sslam;

TEST_CASE("hamming counts the bits that differ") {
  Descriptor a, b;
  CHECK(hamming(a, b) == 0);
  b.words = {1, 0, 0x8000000000000000ULL, 3};
  CHECK(hamming(a, b) == 4);
  CHECK(hamming(b, a) == 4);
  a.words.fill(~std::uint64_t{0});
  CHECK(hamming(a, Descriptor{}) == 256);
  CHECK(a != b);
}

TEST_CASE("an inline vector refuses what does not fit") {
  InlineVector<int, 3> v;
  CHECK(v.empty());
  CHECK(v.capacity() == 3);
  for (int i = 1; i <= 3; ++i) CHECK(v.push_back(i));
  CHECK(v.full());
  CHECK_FALSE(v.push_back(4));
  CHECK(v.size() == 3);
  CHECK(v.back() == 3);
}

TEST_CASE("an inline vector removes in place and is a span") {
  InlineVector<int, 4> v;
  for (int i = 1; i <= 4; ++i) REQUIRE(v.push_back(i));
  v.swap_remove(0);
  CHECK(v[0] == 4);
  v.swap_remove(2);
  CHECK(v.size() == 2);
  const std::span<const int> all = v;
  CHECK(all.size() == 2);
  CHECK(all[1] == 2);
  int sum = 0;
  for (const int i : v) sum += i;
  CHECK(sum == 6);
  v.pop_back();
  CHECK(v.size() == 1);
  v.clear();
  CHECK(v.empty());
}

TEST_CASE("random numbers are a function of the seed") {
  // SplitMix64 from seed 1234567, the reference sequence of its authors.
  Random reference(1234567);
  CHECK(reference.next() == 6457827717110365317ULL);
  CHECK(reference.next() == 3203168211198807973ULL);
  Random a(42), b(42), c(43);
  CHECK(a.next() == b.next());
  CHECK(a.next() != c.next());
}

TEST_CASE("random numbers stay in their range and fill it") {
  Random random(7);
  std::array<int, 10> counts{};
  for (int i = 0; i < 10000; ++i) {
    const auto k = random.below(10);
    REQUIRE(k < 10);
    ++counts[k];
  }
  for (const int n : counts) CHECK(std::abs(n - 1000) < 150);
  double sum = 0;
  for (int i = 0; i < 10000; ++i) {
    const double x = random.uniform(-2.0, 4.0);
    REQUIRE(x >= -2);
    REQUIRE(x < 4);
    sum += x;
  }
  CHECK(std::abs(sum / 10000 - 1) < 0.1);
}

TEST_CASE("a float never rounds up to the end of its range") {
  Random random(8);
  float largest = 0;
  for (int i = 0; i < 50000000; ++i) largest = std::max(largest, random.uniform(0.0F, 1.0F));
  CHECK(largest < 1);
  CHECK(largest > 0.999999F);
}

TEST_CASE("only ok is usable and every status has a name of its own") {
  std::set<std::string> names;
  for (int i = 0; i <= static_cast<int>(Status::kNotFinite); ++i) {
    const auto status = static_cast<Status>(i);
    CHECK(usable(status) == (status == Status::kOk));
    names.insert(name(status));
  }
  CHECK(names.size() == static_cast<std::size_t>(Status::kNotFinite) + 1);
  CHECK(names.count("unknown") == 0);
}

TEMPLATE_TEST_CASE("degrees and radians", "", SSLAM_TEST_SCALARS) {
  CHECK(std::abs(radians(TestType(180)) - std::numbers::pi_v<TestType>) < TestType(1e-6));
  CHECK(std::abs(degrees(radians(TestType(33))) - 33) < TestType(1e-5));
}
