// SPDX-License-Identifier: BSD-3-Clause
// Hamming distances of one descriptor to several of a list, with the instruction that counts bits where the
// processor has it: nearly all x86-64 have, but the architecture does not promise it, so it is asked for at
// run time. A block at a time, since a function for another processor cannot be inlined.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "sslam/core/descriptor.hpp"

namespace sslam {

template <std::size_t N>
using HammingBlock = std::array<int, N>;

namespace detail {

#if defined(__x86_64__) && !defined(__POPCNT__)
template <std::size_t N>
[[gnu::target("popcnt")]] void count_block(const Descriptor& query, std::span<const Descriptor> all,
                                           const std::array<std::int32_t, N>& which, std::size_t count,
                                           HammingBlock<N>& bits) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const Descriptor& other = all[static_cast<std::size_t>(which[i])];
    bits[i] = 0;
    for (std::size_t w = 0; w < other.words.size(); ++w)
      bits[i] += __builtin_popcountll(query.words[w] ^ other.words[w]);
  }
}
#endif

}  // namespace detail

// bits[i]: in how many bits `query` and all[which[i]] differ, for i below `count`; the others stay.
template <std::size_t N>
void hamming_block(const Descriptor& query, std::span<const Descriptor> all,
                   const std::array<std::int32_t, N>& which, std::size_t count,
                   HammingBlock<N>& bits) noexcept {
#if defined(__x86_64__) && !defined(__POPCNT__)
  static const bool counts_bits = __builtin_cpu_supports("popcnt") != 0;
  if (counts_bits) {
    detail::count_block(query, all, which, count, bits);
    return;
  }
#endif
  for (std::size_t i = 0; i < count; ++i) bits[i] = hamming(query, all[static_cast<std::size_t>(which[i])]);
}

}  // namespace sslam
