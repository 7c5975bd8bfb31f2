// SPDX-License-Identifier: BSD-3-Clause
// A StageTimer by the steady clock, in milliseconds.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

#include "sslam/track/contract/stage_timer.hpp"

namespace sslam {

class WallTimer {
 public:
  void begin() noexcept {
    milliseconds.fill(0);
    start_ = last_ = Clock::now();
  }
  void end(Stage stage) noexcept {
    const auto now = Clock::now();
    milliseconds[static_cast<std::size_t>(stage)] +=
        std::chrono::duration<float, std::milli>(now - last_).count();
    last_ = now;
  }
  [[nodiscard]] float total() const noexcept {
    return std::chrono::duration<float, std::milli>(Clock::now() - start_).count();
  }

  std::array<float, kStageCount> milliseconds{};

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_{}, last_{};
};
static_assert(StageTimer<WallTimer>);

}  // namespace sslam
