// SPDX-License-Identifier: BSD-3-Clause
// How large an image may claim to be, so that a small file cannot fill the memory.
#pragma once

#include <cstdint>

namespace sslam::cli {

// More than any camera of a robot or a phone gives. A calibration for larger images lets these in.
inline constexpr std::int64_t kMostPixels = 200'000'000;

// Of an image's file: enough for so many pixels of 16 bit without compression.
inline constexpr std::uintmax_t kMostImageBytes = std::uintmax_t{1} << 31;

}  // namespace sslam::cli
