// SPDX-License-Identifier: BSD-3-Clause
// The frame in hand and the last two that were tracked before it, in buffers that serve again.
#pragma once

#include <array>
#include <cstddef>

#include "sslam/track/contract/tracked_frame.hpp"

namespace sslam {

template <Scalar S>
class FrameHistory {
 public:
  // The frame becomes the current one; it is left the buffers of the oldest, or of a lost one, to fill again.
  void begin(Frame<S>& frame) {
    if (!lost_) now_ = (now_ + 1) % frames_.size();
    lost_ = false;
    current().adopt(frame);
  }

  // The current frame has no place: it stands where the last one stood, and will not be one of the last.
  void lose() {
    lost_ = true;
    current().forget_matches();
    current().cam_from_world = last().cam_from_world;
  }

  // The current frame stands in another world, of which those before it know nothing.
  void change_world() {
    for (TrackedFrame<S>& frame : frames_)
      if (&frame != &current()) frame.forget_matches();
    last().cam_from_world = current().cam_from_world;
  }

  [[nodiscard]] TrackedFrame<S>& current() noexcept { return frames_[now_]; }
  [[nodiscard]] const TrackedFrame<S>& current() const noexcept { return frames_[now_]; }
  [[nodiscard]] TrackedFrame<S>& last() noexcept { return frames_[(now_ + 2) % frames_.size()]; }
  [[nodiscard]] const TrackedFrame<S>& before_last() const noexcept {
    return frames_[(now_ + 1) % frames_.size()];
  }
  [[nodiscard]] std::array<TrackedFrame<S>, 3>& all() noexcept { return frames_; }

 private:
  std::array<TrackedFrame<S>, 3> frames_;
  std::size_t now_ = 0;
  bool lost_ = false;
};

}  // namespace sslam
