// SPDX-License-Identifier: BSD-3-Clause
// How long to wait for a stream that says nothing. Every wait of a reader asks.
#pragma once

#include <chrono>
#include <functional>
#include <utility>

namespace sslam::cli {

class Patience {
 public:
  // `stop`: whether waiting has become pointless; asked from the reader's thread.
  explicit Patience(std::function<bool()> stop) : stop_(std::move(stop)) {}

  // From now on, silence of so many seconds is too long; 0: none is.
  void allow(double seconds) {
    allowed_ = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    heard();
  }
  void heard() { heard_ = Clock::now(); }

  [[nodiscard]] bool over() const {
    return stop_() || (allowed_ > Clock::duration::zero() && Clock::now() - heard_ > allowed_);
  }

  // The longest that a wait may last before it asks again.
  static constexpr std::chrono::milliseconds kLook{50};

 private:
  using Clock = std::chrono::steady_clock;
  std::function<bool()> stop_;
  Clock::duration allowed_{};
  Clock::time_point heard_ = Clock::now();
};

}  // namespace sslam::cli
