// SPDX-License-Identifier: BSD-3-Clause
// Seeded pseudo-random numbers without hidden state (SplitMix64; Steele, Lea, Flood, OOPSLA 2014): the same
// seed gives the same sequence on every compiler, which std::uniform_int_distribution does not promise.
#pragma once

#include <cstdint>
#include <limits>

#include "sslam/core/types.hpp"

namespace sslam {

class Random {
 public:
  explicit constexpr Random(std::uint64_t seed) noexcept : state_(seed) {}

  [[nodiscard]] constexpr std::uint64_t next() noexcept {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }

  // Uniform in [0, bound); bound must not be 0.
  [[nodiscard]] constexpr std::uint32_t below(std::uint32_t bound) noexcept {
    return static_cast<std::uint32_t>(((next() >> 32) * bound) >> 32);
  }

  // Uniform in [low, high).
  template <Scalar S>
  [[nodiscard]] constexpr S uniform(S low, S high) noexcept {
    // As many bits as S holds: one more would round up to `high` at times.
    constexpr int kBits = std::numeric_limits<S>::digits;
    constexpr S kUnit = S(1) / static_cast<S>(std::uint64_t{1} << kBits);
    return low + (high - low) * (static_cast<S>(next() >> (64 - kBits)) * kUnit);
  }

 private:
  std::uint64_t state_;
};

}  // namespace sslam
