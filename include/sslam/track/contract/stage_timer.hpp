// SPDX-License-Identifier: BSD-3-Clause
// The timing hook of the pipeline. The library itself reads no clock: the null timer costs nothing.
#pragma once

#include <concepts>
#include <cstdint>

namespace sslam {

enum class Stage : std::uint8_t {
  kRotation,
  kInitialisation,
  kTranslation,
  kFallback,
  kRefinement,
  kMapping,
  kLoops
};
inline constexpr int kStageCount = 7;

[[nodiscard]] constexpr const char* name(Stage stage) noexcept {
  switch (stage) {
    case Stage::kRotation:
      return "rotation";
    case Stage::kInitialisation:
      return "initialisation";
    case Stage::kTranslation:
      return "translation";
    case Stage::kFallback:
      return "fallback";
    case Stage::kRefinement:
      return "refinement";
    case Stage::kMapping:
      return "mapping";
    case Stage::kLoops:
      return "loops";
  }
  return "unknown";
}

// begin() starts a frame; end(stage) charges the time since the last call to that stage.
template <class T>
concept StageTimer = requires(T timer, Stage stage) {
  timer.begin();
  timer.end(stage);
};

struct NoTimer {
  void begin() noexcept {}
  void end(Stage) noexcept {}
};
static_assert(StageTimer<NoTimer>);

}  // namespace sslam
