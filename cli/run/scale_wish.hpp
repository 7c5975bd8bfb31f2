// SPDX-License-Identifier: BSD-3-Clause
// What --scale asks for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace sslam::cli {

enum class ScaleMethod { kNone, kDepth, kHeight, kKnown };

struct ScaleWish {
  ScaleMethod method = ScaleMethod::kNone;
  double metres = 0;                          // height, or known distance
  std::optional<std::int64_t> first, second;  // frames that are `metres` apart; empty: the first and the last
                                              // with a pose
};

// "none", "depth", "height=1.4", "known=2.5", "known=2.5@120:480". Throws UsageError.
[[nodiscard]] ScaleWish parse_scale(const std::string& text);

}  // namespace sslam::cli
