// SPDX-License-Identifier: BSD-3-Clause
// The frame in hand and the two before it, in buffers that serve again.
#pragma once

#include <array>
#include <cstddef>

#include "sslam/track/tracked_frame.hpp"

namespace sslam {

template <Scalar S>
class FrameHistory {
 public:
  // The frame becomes the current one; it is left the buffers of the oldest to fill again.
  void begin(Frame<S>& frame) {
    now_ = (now_ + 1) % frames_.size();
    current().adopt(frame);
  }

  [[nodiscard]] TrackedFrame<S>& current() noexcept { return frames_[now_]; }
  [[nodiscard]] const TrackedFrame<S>& current() const noexcept { return frames_[now_]; }
  [[nodiscard]] TrackedFrame<S>& last() noexcept { return frames_[(now_ + 2) % frames_.size()]; }
  [[nodiscard]] const TrackedFrame<S>& before_last() const noexcept {
    return frames_[(now_ + 1) % frames_.size()];
  }

 private:
  std::array<TrackedFrame<S>, 3> frames_;
  std::size_t now_ = 0;
};

}  // namespace sslam
