// SPDX-License-Identifier: BSD-3-Clause
#include "sslam/core/hamming_block.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

#include "sslam/core/random.hpp"
#include "support/catch.hpp"

using namespace sslam;

TEST_CASE("the Hamming distances of a block are those of its descriptors one by one") {
  Random random(11);
  std::array<Descriptor, 20> all;
  for (Descriptor& descriptor : all)
    for (auto& word : descriptor.words) word = random.next() & random.next();
  std::array<std::int32_t, 7> which{};
  for (auto& at : which) at = static_cast<std::int32_t>(random.below(all.size()));
  HammingBlock<7> bits{};
  bits.fill(-1);
  hamming_block(all[0], all, which, 5, bits);
  for (std::size_t i = 0; i < 5; ++i)
    CHECK(bits[i] == hamming(all[0], all[static_cast<std::size_t>(which[i])]));
  CHECK(bits[5] == -1);
  CHECK(bits[6] == -1);
}
