// SPDX-License-Identifier: BSD-3-Clause
// A number that tells files apart which differ by accident, not by malice.
#pragma once

#include <cstdint>
#include <string_view>

namespace sslam::io {

// FNV-1a, 64 bits.
[[nodiscard]] inline std::uint64_t checksum(std::string_view bytes) noexcept {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3ULL;
  return hash;
}

}  // namespace sslam::io
