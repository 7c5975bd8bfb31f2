// SPDX-License-Identifier: BSD-3-Clause
// What CLI11 says of a wrong command line, as one line for people.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace sslam::cli {

// Ranges without an upper end are told without the 309 digits of the largest number.
[[nodiscard]] inline std::string usage_text(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  constexpr std::string_view kEndless = " not in range 0.000000 to 179769313486231";
  if (const auto at = text.find(kEndless); at != std::string::npos) {
    const auto end = text.find_first_not_of("0123456789.", at + kEndless.size());
    text.replace(at, std::min(end, text.size()) - at, " is out of range; expected a positive number");
  }
  return text;
}

}  // namespace sslam::cli
