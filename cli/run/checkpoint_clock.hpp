// SPDX-License-Identifier: BSD-3-Clause
// When the next checkpoint of a run is due.
#pragma once

#include <algorithm>
#include <chrono>

namespace sslam::cli {

class CheckpointClock {
 public:
  // From one to the next there are at least so many seconds (0: none is wanted), and so many times what the
  // last one took: a large map then costs no more than its share.
  CheckpointClock(double seconds, double times) : seconds_(seconds), times_(times) {}

  [[nodiscard]] bool is_due() const { return wanted() && since(last_) >= std::max(seconds_, times_ * cost_); }
  [[nodiscard]] bool wanted() const noexcept { return seconds_ > 0; }
  void give_up() noexcept { seconds_ = 0; }

  // Around the writing of one; the answer is what it took, in seconds.
  void begin() { begun_ = Clock::now(); }
  double end() {
    last_ = Clock::now();
    return cost_ = std::chrono::duration<double>(last_ - begun_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] static double since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
  }

  double seconds_, times_;
  double cost_ = 0;
  Clock::time_point last_ = Clock::now(), begun_{};
};

}  // namespace sslam::cli
