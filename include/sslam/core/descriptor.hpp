// SPDX-License-Identifier: BSD-3-Clause
// A 256-bit binary descriptor (ORB, LBD) and its Hamming distance.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace sslam {

struct Descriptor {
  std::array<std::uint64_t, 4> words{};

  friend bool operator==(const Descriptor&, const Descriptor&) = default;
};

// Number of bits that differ, in [0, 256].
[[nodiscard]] constexpr int hamming(const Descriptor& a, const Descriptor& b) noexcept {
  int bits = 0;
  for (std::size_t i = 0; i < a.words.size(); ++i) bits += std::popcount(a.words[i] ^ b.words[i]);
  return bits;
}

}  // namespace sslam
