// SPDX-License-Identifier: BSD-3-Clause
// Numbers one after the other, little-endian, as the report's page reads them.
#pragma once

#include <bit>
#include <string>
#include <type_traits>

namespace sslam::cli {

struct ByteWriter {
  static_assert(std::endian::native == std::endian::little);
  std::string bytes;

  template <class T>
  requires std::is_arithmetic_v<T>
  void put(T value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }
};

}  // namespace sslam::cli
