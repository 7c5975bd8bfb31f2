// SPDX-License-Identifier: BSD-3-Clause
// Input of a kernel with some of its numbers replaced by what no sensor sends: seeded, the same wherever it
// runs.
#pragma once

#include <array>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/core/types.hpp"

namespace sslam::testing {

template <Scalar S>
[[nodiscard]] S any_number(Random& random) {
  using Limits = std::numeric_limits<S>;
  constexpr std::array<S, 14> kOdd{0,
                                   S(-0.0),
                                   1,
                                   -1,
                                   Limits::denorm_min(),
                                   Limits::min(),
                                   Limits::epsilon(),
                                   S(1e-30),
                                   S(1e10),
                                   S(1e30),
                                   Limits::max(),
                                   Limits::lowest(),
                                   Limits::infinity(),
                                   Limits::quiet_NaN()};
  return kOdd[random.below(kOdd.size())];
}

// Of structs that hold nothing but numbers: `count` numbers anywhere in them become odd ones.
template <Scalar S, class T>
void spoil(std::span<T> items, int count, Random& random) {
  static_assert(sizeof(T) % sizeof(S) == 0);
  const std::span<std::byte> bytes = std::as_writable_bytes(items);
  for (int i = 0; i < count && !items.empty(); ++i) {
    const S odd = any_number<S>(random);
    const std::size_t at = random.below(static_cast<std::uint32_t>(bytes.size() / sizeof(S)));
    std::memcpy(bytes.data() + at * sizeof(S), &odd, sizeof(S));
  }
}

// The items over and over, from none to more than any sample holds, with up to three numbers spoiled.
template <Scalar S, class T>
[[nodiscard]] std::vector<T> spoiled(const std::vector<T>& items, Random& random) {
  constexpr std::array<std::size_t, 10> kSizes{0, 1, 2, 3, 4, 5, 8, 127, 500, 3000};
  std::vector<T> chosen;
  const std::size_t size = kSizes[random.below(kSizes.size())];
  for (std::size_t i = 0; i < size; ++i) chosen.push_back(items[i % items.size()]);
  spoil<S>(std::span<T>(chosen), static_cast<int>(random.below(4)), random);
  return chosen;
}

}  // namespace sslam::testing
