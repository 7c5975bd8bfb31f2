// SPDX-License-Identifier: BSD-3-Clause
// What a kernel answers: one code for success and one for each way the geometry can refuse.
#pragma once

#include <cstdint>

namespace sslam {

enum class Status : std::uint8_t {
  kOk,            // the answer may be used
  kTooFew,        // fewer observations than unknowns, or than the caller's minimum
  kDegenerate,    // the observations leave a direction of the answer undetermined
  kLowParallax,   // the views are too close together for a depth
  kBehind,        // the answer lies behind a camera
  kNoConsensus,   // no model agrees with enough of the observations
  kNotConverged,  // the iteration budget ran out; the best state so far is returned
  kNotFinite,     // an input was NaN or infinite
};

[[nodiscard]] constexpr bool usable(Status status) noexcept {
  return status == Status::kOk;
}

[[nodiscard]] constexpr const char* name(Status status) noexcept {
  switch (status) {
    case Status::kOk:
      return "ok";
    case Status::kTooFew:
      return "too few observations";
    case Status::kDegenerate:
      return "degenerate";
    case Status::kLowParallax:
      return "low parallax";
    case Status::kBehind:
      return "behind the camera";
    case Status::kNoConsensus:
      return "no consensus";
    case Status::kNotConverged:
      return "not converged";
    case Status::kNotFinite:
      return "not finite";
  }
  return "unknown";
}

}  // namespace sslam
