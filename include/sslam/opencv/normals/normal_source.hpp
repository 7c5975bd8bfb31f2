// SPDX-License-Identifier: BSD-3-Clause
// The socket for whatever knows surface normals: a depth map, stored files, a network, or nothing.
#pragma once

#include <concepts>
#include <cstdint>

#include "sslam/geometry/camera.hpp"
#include "sslam/map/frame.hpp"
#include "sslam/opencv/image_input.hpp"

namespace sslam {

enum class NormalStatus : std::uint8_t {
  kOk,
  kNoInput,     // this frame has no depth image, or no file of normals
  kUnreadable,  // a file is there, but cannot be decoded
  kWrongSize,   // the shape does not fit the camera's image
  kWrongType,   // number of channels or depth of the pixels
  kFacesAway,   // most normals point away from the camera: the axes are stored in another order or sign
  kTooSmall,    // the image has too few pixels for the network
  kBadOutput,   // the network's values are not finite, not of unit length, or not in the range of their kind
  kOutOfRange,  // hardly any depth lies in the range that is used: its factor is wrong, or the room is huge
  kNoEvidence,  // nothing is wrong, but too few pixels are planar, or their normals disagree
};

[[nodiscard]] constexpr const char* name(NormalStatus status) noexcept {
  switch (status) {
    case NormalStatus::kOk:
      return "ok";
    case NormalStatus::kNoInput:
      return "no input for the normals";
    case NormalStatus::kUnreadable:
      return "unreadable file of normals";
    case NormalStatus::kWrongSize:
      return "the shape of the normals' input does not fit the camera";
    case NormalStatus::kFacesAway:
      return "most normals point away from the camera (wrong order or sign of the axes?)";
    case NormalStatus::kWrongType:
      return "the normals' input has the wrong pixel type";
    case NormalStatus::kTooSmall:
      return "the image is too small for the network of normals";
    case NormalStatus::kBadOutput:
      return "the network's output is not finite, not of unit length or not in [0, 1]";
    case NormalStatus::kOutOfRange:
      return "hardly any depth lies in the range that is used (is its factor right?)";
    case NormalStatus::kNoEvidence:
      return "too few planar pixels, or normals that disagree: no Manhattan evidence";
  }
  return "unknown";
}

// fill(input, camera, field) replaces the contents of `field`; it leaves it empty unless it answers kOk.
template <class T>
concept NormalSource = requires(T source, const ImageInput& input, const Camera<double>& camera,
                                NormalField& field) {
  { source.fill(input, camera, field) } -> std::same_as<NormalStatus>;
};

}  // namespace sslam
