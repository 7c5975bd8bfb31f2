// SPDX-License-Identifier: BSD-3-Clause
// What an error or a list of warnings must say.
#pragma once

#include <string>
#include <vector>

#include "sslam/core/error.hpp"
#include "support/catch.hpp"

namespace sslam::testing {

// The message of the Error that `action` throws; empty when it throws none.
template <class Action>
[[nodiscard]] std::string error_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

[[nodiscard]] inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

[[nodiscard]] inline bool is_one_line(const std::string& text) {
  return !text.empty() && text.find('\n') == std::string::npos;
}

}  // namespace sslam::testing
