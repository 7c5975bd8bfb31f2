// SPDX-License-Identifier: BSD-3-Clause
// Numbers as bytes one after the other, little-endian, and back.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "sslam/core/error.hpp"
#include "sslam/io/maps/field_range.hpp"

namespace sslam::io {

static_assert(std::endian::native == std::endian::little);

struct ByteWriter {
  static constexpr bool kReads = false;
  std::string bytes;

  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(const T& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }

  // A field that its reader will hold against a range.
  template <class T>
  void operator()(const T& value, const FieldRange<T>&) {
    (*this)(value);
  }

  // Its length, then its bytes.
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint64_t>(text.size()));
    bytes += text;
  }
};

// Takes from the front of a view; throws Error at its end, and where a field is out of its range.
class ByteReader {
 public:
  static constexpr bool kReads = true;
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(T& value) { std::memcpy(&value, take(sizeof value).data(), sizeof value); }

  template <class T>
  void operator()(T& value, const FieldRange<T>& range) {
    (*this)(value);
    range.demand(value);
  }

  void operator()(std::string& text) {
    std::uint64_t size = 0;
    (*this)(size);
    text = take(size);
  }

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
