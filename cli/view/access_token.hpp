// SPDX-License-Identifier: BSD-3-Clause
// What stands in the address of a server of ours, so that nobody else on the machine can guess it.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <string_view>

namespace sslam::cli {

// 128 bits from the system's source of randomness.
[[nodiscard]] inline std::string random_token() {
  constexpr char kDigits[] = "0123456789abcdef";
  std::random_device source;
  std::string token;
  for (int i = 0; i < 32; ++i) token += kDigits[source() & 15];
  return token;
}

// In a time that does not tell how much of it is right.
[[nodiscard]] inline bool same_text(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  int different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different |= a[i] ^ b[i];
  return different == 0;
}

}  // namespace sslam::cli
