// SPDX-License-Identifier: BSD-3-Clause
// A 256-bit binary descriptor (ORB, LBD) and its Hamming distance.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace sslam {

struct Descriptor {
  std::array<std::uint64_t, 4> words{};

  friend bool operator==(const Descriptor&, const Descriptor&) = default;
};

// Number of bits that differ, in [0, 256]. Without an instruction that counts bits, which x86-64 alone does
// not promise, std::popcount calls a library function for each word: four words at a time are counted in
// fields that double in width instead (Warren, Hacker's Delight, section 5-1).
[[nodiscard]] constexpr int hamming(const Descriptor& a, const Descriptor& b) noexcept {
#ifdef __POPCNT__
  int bits = 0;
  for (std::size_t i = 0; i < a.words.size(); ++i) bits += std::popcount(a.words[i] ^ b.words[i]);
  return bits;
#else
  constexpr std::uint64_t k1 = 0x5555555555555555, k2 = 0x3333333333333333, k4 = 0x0F0F0F0F0F0F0F0F,
                          k8 = 0x00FF00FF00FF00FF, k16 = 0x0001000100010001;
  const auto fours = [&](std::size_t i) {  // bits set, in fields of four bits: at most 4 in each
    const std::uint64_t x = a.words[i] ^ b.words[i], twos = x - (x >> 1 & k1);
    return (twos & k2) + (twos >> 2 & k2);
  };
  const auto eights = [](std::uint64_t x) { return (x & k4) + (x >> 4 & k4); };
  const std::uint64_t sum = eights(fours(0) + fours(1)) + eights(fours(2) + fours(3));  // at most 32 in each
  return static_cast<int>(((sum & k8) + (sum >> 8 & k8)) * k16 >> 48);
#endif
}

}  // namespace sslam
