// SPDX-License-Identifier: BSD-3-Clause
// One line a message on standard error, so that standard output stays a table or a result.
#pragma once

#include <cstdio>
#include <span>
#include <string>

namespace sslam::cli {

inline void print_error(const std::string& text) {
  std::fprintf(stderr, "sslam: error: %s\n", text.c_str());
}
inline void print_warning(const std::string& text) {
  std::fprintf(stderr, "sslam: warning: %s\n", text.c_str());
}
inline void print_note(const std::string& text) {
  std::fprintf(stderr, "sslam: note: %s\n", text.c_str());
}

// The first few in full, then a count: a thousand bad frames must not hide the line that matters.
inline void print_warnings(std::span<const std::string> warnings, std::size_t at_most = 10) {
  const std::size_t shown = warnings.size() <= at_most ? warnings.size() : at_most - 1;
  for (std::size_t i = 0; i < shown; ++i) print_warning(warnings[i]);
  if (shown < warnings.size())
    print_warning("and " + std::to_string(warnings.size() - shown) + " more like these");
}

}  // namespace sslam::cli
