// SPDX-License-Identifier: BSD-3-Clause
// The shortest text that reads back as the same number.
#pragma once

#include <charconv>
#include <string>
#include <type_traits>

namespace sslam {

template <class T>
requires std::is_arithmetic_v<T>
[[nodiscard]] std::string shortest_text(T value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace sslam
