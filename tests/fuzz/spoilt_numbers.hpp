// SPDX-License-Identifier: BSD-3-Clause
// What the fuzzers of kernels do: a sound scene as numbers, and a few of them spoilt as the fuzzer says.
// Numbers from the fuzzer alone would never get past the first check of a kernel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "sslam/core/random.hpp"

namespace sslam::fuzzing {

// Reads the fuzzer's bytes; zeros beyond their end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : left_(data, size) {}

  [[nodiscard]] bool empty() const noexcept { return left_.empty(); }
  template <class T>
  [[nodiscard]] T take() noexcept {
    T value{};
    const std::size_t size = left_.size() < sizeof(T) ? left_.size() : sizeof(T);
    if (size > 0) std::memcpy(&value, left_.data(), size);
    left_ = left_.subspan(size);
    return value;
  }

 private:
  std::span<const std::uint8_t> left_;
};

// Each spoiling is a kind, a place and, for some, an argument. `row`: numbers that belong together.
inline void spoil(std::span<double> numbers, std::size_t row, Bytes& bytes) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kValues[] = {std::numeric_limits<double>::quiet_NaN(),
                                kInfinity,
                                -kInfinity,
                                0,
                                1,
                                -1,
                                1e300,
                                -1e300,
                                1e160,
                                1e-160,
                                1e-320,
                                1e8};
  constexpr std::size_t kMost = 64;
  for (std::size_t i = 0; i < kMost && !bytes.empty(); ++i) {
    const auto kind = bytes.take<std::uint8_t>();
    const std::size_t at = bytes.take<std::uint16_t>() % numbers.size();
    const std::size_t first = at / row * row;
    if (kind < std::size(kValues)) {
      numbers[at] = kValues[kind];
    } else if (kind < 2 * std::size(kValues)) {  // a column
      for (std::size_t k = at % row; k < numbers.size(); k += row)
        numbers[k] = kValues[kind - std::size(kValues)];
    } else if (kind < 3 * std::size(kValues)) {  // everything, larger or smaller
      for (double& number : numbers) number *= kValues[kind - 2 * std::size(kValues)];
    } else if (kind < 64) {  // a row again in the place of another, or of all others
      const std::size_t to = bytes.take<std::uint16_t>() % (numbers.size() / row) * row;
      for (std::size_t other = 0; other + row <= numbers.size(); other += row)
        if (other == to || kind < 48)
          for (std::size_t k = 0; k < row; ++k) numbers[other + k] = numbers[first + k];
    } else if (kind < 128) {
      numbers[at] = bytes.take<double>();
    } else {  // a little
      numbers[at] += static_cast<double>(bytes.take<std::int16_t>()) / (kind < 192 ? 1e3 : 1e6);
    }
  }
}

// Of vectors: NaN is the same as NaN.
template <class Vector>
[[nodiscard]] bool same_bits(const Vector& a, const Vector& b) {
  return std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(a[0])) == 0;
}

inline void demand(bool held) {
  if (!held) std::abort();
}

}  // namespace sslam::fuzzing
