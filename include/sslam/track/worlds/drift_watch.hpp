// SPDX-License-Identifier: BSD-3-Clause
// Drift away from the Manhattan frame. In a quick turn few landmarks hold the camera; a pose that is a little
// off makes landmarks that are, and the next pose fits those. The Manhattan frame does not drift along.
#pragma once

#include <algorithm>
#include <limits>

#include "sslam/core/parameter.hpp"
#include "sslam/geometry/spread.hpp"
#include "sslam/track/contract/tracked_frame.hpp"

namespace sslam {

template <Scalar S>
struct DriftWatchOptions {
  double after = 0.25;            // seconds of poses that contradict the Manhattan frame, until it is drift
  int weak = 50;                  // points plus lines: only a pose that fewer hold can drift
  double square = 10;             // seconds of poses that agree for each that does not; else the world is not
                                  // square enough to tell drift from walls that stand at other angles
  S max_sigma = radians(S(2.5));  // of a Manhattan rotation that says that a pose agrees with it

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("after", self.after, Unit::kSeconds, 0, 3600,
          "of poses that contradict the Manhattan frame, until the camera counts as drifted");
    visit("weak", self.weak, Unit::kCount, 0, 1000000,
          "points plus lines: only a pose that fewer hold drifts");
    visit("square", self.square, Unit::kNumber, 0, 1e6,
          "time of poses that agree over that of those that do not, from which a contradiction is drift");
    visit("max_sigma", self.max_sigma, Unit::kDegrees, 0, 180,
          "standard deviation of a Manhattan rotation that a pose agrees with");
  }
};
static_assert(Described<DriftWatchOptions<double>>);

template <Scalar S>
class DriftWatch {
 public:
  DriftWatchOptions<S> options;

  // A frame has a pose that so many points and lines hold, so many seconds after the frame before it.
  void weigh(const TrackedFrame<S>& frame, bool contradicts, int held_by, double seconds) {
    weakest_ = std::min(weakest_, held_by);
    if (contradicts) {
      if (drift_ == 0) began_after_ = std::max(last_agreed_, frame.frame.stamp - kUnnoticed);
      drift_ += seconds;
    } else if (tells(frame)) {
      agreed_ += seconds;
      last_agreed_ = frame.frame.stamp;
      end();
    }
  }

  // Since the last frame that agreed with the Manhattan frame, poses hung on little and contradict it.
  [[nodiscard]] bool drifted() const noexcept {
    constexpr double kLeast = 1;  // seconds of a world, to call it square
    return weakest_ < options.weak && drift_ >= options.after - kStampError &&
           agreed_ >= std::max(kLeast, options.square * against_);
  }

  // Stamp of the last frame that is not in doubt: the last that agreed, or where none did for long before the
  // first contradiction, a second before that. A drift is small at first, and contradicts nothing.
  [[nodiscard]] double began_after() const noexcept { return began_after_; }

  // Whether the Manhattan rotation of the frame is certain enough to agree with.
  [[nodiscard]] bool tells(const TrackedFrame<S>& frame) const {
    return frame.manhattan && largest_sigma<S>(frame.manhattan->covariance) < options.max_sigma;
  }

  // The camera is where it was before, or has been found elsewhere.
  void end() noexcept {
    against_ += drift_;
    drift_ = 0;
    weakest_ = kNobody;
  }

  void begin_again() noexcept {
    drift_ = against_ = agreed_ = 0;
    weakest_ = kNobody;
  }

 private:
  static constexpr double kStampError = 1e-3;  // seconds, at best
  static constexpr double kUnnoticed = 1;      // seconds that a drift may go on before a pose contradicts
  static constexpr int kNobody = std::numeric_limits<int>::max();

  // Seconds of frames, each with the time since the one before it.
  double drift_ = 0;    // those that contradict, since the last one that agreed
  double against_ = 0;  // those before
  double agreed_ = 0;   // all that agreed
  double began_after_ = 0;
  double last_agreed_ = -std::numeric_limits<double>::infinity();  // stamp
  int weakest_ = kNobody;  // points plus lines of the frame since then that fewest held
};

}  // namespace sslam
