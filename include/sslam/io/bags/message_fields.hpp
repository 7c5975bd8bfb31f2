// SPDX-License-Identifier: BSD-3-Clause
// The fields of a ROS message one after the other: as ROS 1 writes them, or ROS 2 (CDR: XTypes 1.3, 7.4.3).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sslam/core/error.hpp"

namespace sslam::io {

// CDR aligns each number to its own size and ends texts with a zero; ROS 1 does neither.
enum class Wire : std::uint8_t { kRos1, kCdr };

// Takes from the front of a message, which must outlive it. Throws Error at its end.
class MessageFields {
 public:
  MessageFields(Wire wire, std::string_view message) : wire_(wire), all_(message) {
    static_assert(std::endian::native == std::endian::little);
    if (wire_ != Wire::kCdr) return;
    const std::string_view head = take(4);
    if (head[0] != 0 || head[1] < 0 || head[1] > 1)
      throw Error("is no plain CDR, the encoding of ROS 2's messages");
    swap_ = head[1] == 0;
    all_.remove_prefix(4);
    at_ = 0;
  }

  [[nodiscard]] Wire wire() const noexcept { return wire_; }

  template <class T>
  requires std::is_arithmetic_v<T>
  [[nodiscard]] T number() {
    if (wire_ == Wire::kCdr) (void)take((sizeof(T) - at_ % sizeof(T)) % sizeof(T));
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), take(sizeof(T)).data(), sizeof(T));
    if (swap_) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }

  [[nodiscard]] std::string_view text() {
    std::string_view text = take(number<std::uint32_t>());
    if (wire_ == Wire::kCdr && text.ends_with('\0')) text.remove_suffix(1);
    return text;
  }

  // uint8[]
  [[nodiscard]] std::string_view bytes() { return take(number<std::uint32_t>()); }

  // float64[] of `most` at most
  [[nodiscard]] std::vector<double> doubles(std::size_t most) {
    const std::size_t count = number<std::uint32_t>();
    if (count > most) throw Error("claims " + std::to_string(count) + " numbers in a list of few");
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(number<double>());
    return values;
  }

  // float64[N]
  template <std::size_t N>
  [[nodiscard]] std::array<double, N> doubles() {
    std::array<double, N> values;
    for (double& value : values) value = number<double>();
    return values;
  }

 private:
  [[nodiscard]] std::size_t left() const noexcept { return all_.size() - at_; }
  std::string_view take(std::size_t size) {
    if (left() < size) throw Error("ends too early");
    at_ += size;
    return all_.substr(at_ - size, size);
  }

  Wire wire_;
  std::string_view all_;
  std::size_t at_ = 0;
  bool swap_ = false;
};

}  // namespace sslam::io
