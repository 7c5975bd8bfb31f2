// SPDX-License-Identifier: BSD-3-Clause
// How often a test draws at random. Sanitizers see a fault in each draw and take ten times as long for it:
// how good the answers are on average is judged without them, by all the draws.
#pragma once

namespace sslam::testing {

#ifdef SSLAM_SANITIZED_TESTS
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

[[nodiscard]] constexpr int trials(int all, int sanitized) noexcept {
  return kSanitized ? sanitized : all;
}

}  // namespace sslam::testing
