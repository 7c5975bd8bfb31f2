// SPDX-License-Identifier: BSD-3-Clause
// The last frames, in the order in which they came, in buffers that serve again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sslam/track/contract/tracked_frame.hpp"

namespace sslam {

template <Scalar S>
class WaitingFrames {
 public:
  struct Entry {
    TrackedFrame<S> frame;
    bool placed = false;  // the frame has a pose
  };

  // Takes a copy; the oldest makes room where there are `most` already. `most` is at least one.
  void add(const TrackedFrame<S>& frame, bool placed, std::size_t most) {
    while (size_ >= most) drop_oldest();
    if (size_ == slots_.size()) grow();
    Entry& entry = slot(size_++);
    entry.frame = frame;
    entry.placed = placed;
  }

  // Keeps the buffers.
  void clear() noexcept { first_ = size_ = 0; }

  [[nodiscard]] std::ptrdiff_t size() const noexcept { return static_cast<std::ptrdiff_t>(size_); }
  // The oldest is 0.
  [[nodiscard]] Entry& operator[](std::ptrdiff_t i) noexcept { return slot(static_cast<std::size_t>(i)); }

 private:
  [[nodiscard]] Entry& slot(std::size_t i) noexcept { return slots_[(first_ + i) % slots_.size()]; }

  void drop_oldest() noexcept {
    first_ = (first_ + 1) % slots_.size();
    --size_;
  }

  void grow() {
    std::rotate(slots_.begin(), slots_.begin() + static_cast<std::ptrdiff_t>(first_), slots_.end());
    first_ = 0;
    slots_.emplace_back();
  }

  std::vector<Entry> slots_;  // a ring
  std::size_t first_ = 0;     // slot of the oldest
  std::size_t size_ = 0;      // slots in use
};

}  // namespace sslam
