// SPDX-License-Identifier: BSD-3-Clause
// Numbers as bytes one after the other, little-endian, and back.
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "sslam/core/error.hpp"

namespace sslam::io {

static_assert(std::endian::native == std::endian::little);

struct ByteWriter {
  static constexpr bool kReads = false;
  std::string bytes;

  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(const T& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }
};

// Takes from the front of a view; throws Error at its end.
class ByteReader {
 public:
  static constexpr bool kReads = true;
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(T& value) { std::memcpy(&value, take(sizeof value).data(), sizeof value); }

  [[nodiscard]] std::string_view take(std::size_t size) {
    if (left_.size() < size) throw Error("ends too early");
    const std::string_view taken = left_.substr(0, size);
    left_.remove_prefix(size);
    return taken;
  }
  [[nodiscard]] std::string_view left() const noexcept { return left_; }

 private:
  std::string_view left_;
};

}  // namespace sslam::io
