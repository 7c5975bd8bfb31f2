// SPDX-License-Identifier: BSD-3-Clause
// Takes numbers and names from the front of a binary file of COLMAP.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "sslam/core/error.hpp"

namespace sslam {

// Throws Error at the end: "SOURCE: is cut off, or no NAME of COLMAP".
class ColmapBytes {
 public:
  ColmapBytes(std::string_view bytes, const std::string& source, const char* name)
      : left_(bytes), cut_off_(source + ": is cut off, or no " + name + " of COLMAP") {}

  template <class T>
  void take(T& value) {
    std::memcpy(&value, front(sizeof value).data(), sizeof value);
    left_.remove_prefix(sizeof value);
  }
  // Up to a zero, which goes with it.
  [[nodiscard]] std::string take_name() {
    const std::size_t end = left_.find('\0');
    if (end == std::string_view::npos) throw Error(cut_off_);
    const std::string name(left_.substr(0, end));
    left_.remove_prefix(end + 1);
    return name;
  }
  void skip(std::uint64_t count, std::size_t size) {
    if (count > left_.size() / size) throw Error(cut_off_);
    left_.remove_prefix(static_cast<std::size_t>(count) * size);
  }

 private:
  [[nodiscard]] std::string_view front(std::size_t size) const {
    if (left_.size() < size) throw Error(cut_off_);
    return left_.substr(0, size);
  }

  std::string_view left_;
  std::string cut_off_;
};

}  // namespace sslam
