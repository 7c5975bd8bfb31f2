// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/map/look_index.hpp"

#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "sslam/core/random.hpp"
#include "support/catch.hpp"

using namespace sslam;

namespace {

constexpr int kMost = 12;

struct Look {
  Descriptor descriptor;
  bool alive = false;
};

Descriptor random_look(Random& random) {
  Descriptor descriptor;
  // Few values, so that pieces are often the same.
  for (auto& word : descriptor.words) word = random.next() & 0x0003000100030001ULL;
  return descriptor;
}

std::uint64_t piece(const Descriptor& d, std::size_t p) {
  return d.words[p / 4] >> (16 * (p % 4)) & 0xFFFFU;
}

std::set<LandmarkId> found(const LookIndex& index, const Descriptor& descriptor) {
  std::set<LandmarkId> ids;
  index.near(descriptor, kMost, [&](LandmarkId id, int bits) {
    CHECK(bits <= kMost);
    CHECK(ids.insert(id).second);  // once each
  });
  return ids;
}

}  // namespace

TEST_CASE("an index of looks that has followed a map finds what one made anew finds") {
  Random random(3);
  std::vector<Look> looks(60);
  LookIndex index;
  index.make(looks);
  for (int step = 0; step < 2000; ++step) {
    const auto id = static_cast<LandmarkId>(random.below(60));
    Look& look = looks[static_cast<std::size_t>(id)];
    look.alive = random.below(3) != 0;
    look.descriptor = random_look(random);
    look.alive ? index.set(id, look.descriptor) : index.remove(id);
    if (step % 50 != 0) continue;
    const Descriptor asked = random_look(random);
    std::set<LandmarkId> expected;
    for (std::size_t i = 0; i < looks.size(); ++i)
      for (std::size_t p = 0; p < 16; ++p)
        if (looks[i].alive && hamming(looks[i].descriptor, asked) <= kMost &&
            piece(looks[i].descriptor, p) == piece(asked, p))
          expected.insert(static_cast<LandmarkId>(i));
    CHECK(found(index, asked) == expected);
    LookIndex anew;
    anew.make(looks);
    CHECK(found(anew, asked) == expected);
  }
}

TEST_CASE("a copy of an index of looks is yet to be made, one that is moved is not") {
  LookIndex index;
  index.make(std::vector<Look>(3));
  CHECK(index.made());
  const LookIndex copy(index);
  CHECK_FALSE(copy.made());
  const LookIndex moved(std::move(index));
  CHECK(moved.made());
}
