// SPDX-License-Identifier: BSD-3-Clause
// Why a frame's surface normals are computed. A network costs more than all the rest of a frame, and changes
// nothing where lines determine the rotation.
#pragma once

#include <array>
#include <cstdint>

namespace sslam {

enum class NormalNeed : std::uint8_t {
  kNotNeeded,         // they cannot change the estimate
  kEveryFrame,        // they are computed for all frames
  kNoManhattanFrame,  // the world has no Manhattan frame yet
  kNoAxis,            // the frame's lines show no axis of it
  kAxisOpen,          // they show one axis only; the turn about it is not determined
  kUncertain,         // they show the rotation, but not precisely enough
};
inline constexpr std::array kNormalNeeds{NormalNeed::kEveryFrame, NormalNeed::kNoManhattanFrame,
                                         NormalNeed::kNoAxis, NormalNeed::kAxisOpen, NormalNeed::kUncertain};

[[nodiscard]] constexpr const char* name(NormalNeed need) noexcept {
  switch (need) {
    case NormalNeed::kNotNeeded:
      return "";
    case NormalNeed::kEveryFrame:
      return "every frame";
    case NormalNeed::kNoManhattanFrame:
      return "no Manhattan frame yet";
    case NormalNeed::kNoAxis:
      return "no axis by lines";
    case NormalNeed::kAxisOpen:
      return "an axis is open";
    case NormalNeed::kUncertain:
      return "uncertain rotation";
  }
  return "unknown";
}

}  // namespace sslam
