// SPDX-License-Identifier: BSD-3-Clause
// What CLI11 lets through where numbers are wanted: nan, and less than 0 where it counts from 0.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <string>

#include "sslam/io/files/text.hpp"

namespace sslam::cli {

// In front of a range, which nan is not outside of.
[[nodiscard]] inline CLI::Validator finite_number() {
  return CLI::Validator(
      [](const std::string& text) {
        const auto value = io::parse_number<double>(text);
        return value && std::isfinite(*value) ? std::string() : "'" + text + "' is not a number";
      },
      "");
}

[[nodiscard]] inline CLI::Validator number_from_zero() {
  return CLI::Validator(
      [](const std::string& text) {
        return io::parse_number<std::uint64_t>(text) ? std::string()
                                                     : "'" + text + "' is not a whole number from 0 on";
      },
      "");
}

}  // namespace sslam::cli
