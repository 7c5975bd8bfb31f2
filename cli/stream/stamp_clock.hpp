// SPDX-License-Identifier: BSD-3-Clause
// Stamps of a stream: seconds since its first frame, always increasing, whatever its own clock does.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>

namespace sslam::cli {

class StampClock {
 public:
  using Clock = std::chrono::steady_clock;

  // by_arrival: frames without a time have that of their arrival; else their number over `frame_rate`.
  StampClock(bool by_arrival, double frame_rate) : by_arrival_(by_arrival), frame_rate_(frame_rate) {}

  // The stream has been connected anew: its clock says something else from here on.
  void reconnect() { anchor_.reset(); }

  // Of the next frame; `time`: on the stream's own clock, if that is known.
  [[nodiscard]] double stamp(std::optional<double> time, Clock::time_point arrived) {
    if (number_ == 0) start_ = arrived;
    const double without = elapsed(arrived);
    double stamp = without;
    if (time && std::isfinite(*time)) {
      if (!anchor_) anchor_ = Anchor{*time, without};
      stamp = anchor_->stamp + *time - anchor_->time;
      if (number_ > 0 && !believable(stamp, without)) {
        anchor_ = Anchor{*time, without};
        stamp = without;
      }
    }
    constexpr double kPerSecond = 1e6;  // microseconds are enough, and short to write
    stamp = std::round(stamp * kPerSecond) / kPerSecond;
    if (number_ > 0) stamp = std::max(stamp, std::round(last_ * kPerSecond + 1) / kPerSecond);
    ++number_;
    return last_ = stamp;
  }

 private:
  struct Anchor {
    double time = 0, stamp = 0;  // the same moment on both clocks
  };

  // What a frame without a time has.
  [[nodiscard]] double elapsed(Clock::time_point arrived) const {
    if (by_arrival_) return std::chrono::duration<double>(arrived - start_).count();
    return anchor_ ? last_ + 1 / frame_rate_ : static_cast<double>(number_) / frame_rate_;
  }

  // A clock that goes back has been set; one that runs away from ours has as well.
  [[nodiscard]] bool believable(double stamp, double without) const {
    constexpr double kApart = 10;  // seconds
    return stamp > last_ && (!by_arrival_ || std::abs(stamp - without) < kApart);
  }

  bool by_arrival_;
  double frame_rate_;
  std::int64_t number_ = 0;
  double last_ = 0;
  Clock::time_point start_{};
  std::optional<Anchor> anchor_;
};

}  // namespace sslam::cli
