// SPDX-License-Identifier: BSD-3-Clause
// Files that tell when they are damaged: length and checksum of changed bytes are mended, which no fuzzer
// guesses.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "sslam/io/maps/sealed_file.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace sslam::fuzzing {

inline constexpr std::size_t kSealedHead = 8 + 4 + 8 + 8;

inline std::size_t mend_sealed(const io::SealedKind& kind, std::uint8_t* data, std::size_t size) {
  const std::string_view fields(reinterpret_cast<const char*>(data) + kSealedHead, size - kSealedHead);
  const std::string start = io::sealed_head(kind, fields);
  std::copy(start.begin(), start.end(), data);
  return size;
}

// Changes a file, and mends it but for one time in sixteen.
inline std::size_t mutate_sealed(const io::SealedKind& kind, std::uint8_t* data, std::size_t size,
                                 std::size_t most, unsigned seed) {
  size = LLVMFuzzerMutate(data, size, most);
  if (size < kSealedHead && kSealedHead <= most) {
    std::fill(data + size, data + kSealedHead, std::uint8_t{0});
    size = kSealedHead;
  }
  return seed % 16 == 0 || size < kSealedHead ? size : mend_sealed(kind, data, size);
}

}  // namespace sslam::fuzzing
