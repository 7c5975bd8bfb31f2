// SPDX-License-Identifier: BSD-3-Clause
// Whether a System can use the input of one call. Unless kOk, the frame is left out and the call does not
// change the system.
#pragma once

#include <cstdint>

#include "sslam/opencv/image_frontend.hpp"

namespace sslam {

enum class InputStatus : std::uint8_t {
  kOk,
  kEmptyImage,
  kWrongSize,
  kWrongType,
  kWrongMask,
  kBadStamp,  // not finite, or not later than that of the previous frame
  kFinished,  // after finish()
};

[[nodiscard]] constexpr InputStatus input_status(ImageStatus status) noexcept {
  switch (status) {
    case ImageStatus::kOk:
      return InputStatus::kOk;
    case ImageStatus::kEmpty:
      return InputStatus::kEmptyImage;
    case ImageStatus::kWrongSize:
      return InputStatus::kWrongSize;
    case ImageStatus::kWrongType:
      return InputStatus::kWrongType;
    case ImageStatus::kWrongMask:
      return InputStatus::kWrongMask;
  }
  return InputStatus::kEmptyImage;
}

[[nodiscard]] constexpr const char* name(InputStatus status) noexcept {
  switch (status) {
    case InputStatus::kOk:
      return "ok";
    case InputStatus::kEmptyImage:
      return name(ImageStatus::kEmpty);
    case InputStatus::kWrongSize:
      return name(ImageStatus::kWrongSize);
    case InputStatus::kWrongType:
      return name(ImageStatus::kWrongType);
    case InputStatus::kWrongMask:
      return name(ImageStatus::kWrongMask);
    case InputStatus::kBadStamp:
      return "the stamp is not later than that of the frame before";
    case InputStatus::kFinished:
      return "the system has finished";
  }
  return "unknown";
}

}  // namespace sslam
