// SPDX-License-Identifier: BSD-3-Clause
// A loss of track: how long it has lasted, and whether it speaks against the map.
#pragma once

#include "sslam/map/map.hpp"

namespace sslam {

template <Scalar S>
class TrackingLoss {
 public:
  int young_map = 5;          // keyframes: a map lost while it has fewer is given up and started anew
  int give_up_after = 15;     // lost frames with enough features until that happens
  int telling_features = 50;  // points plus lines that make a frame speak for or against the map

  [[nodiscard]] bool lasts() const noexcept { return frames_ > 0; }

  // The place in a map that was not made here is yet to be found; however young, that map is not given up.
  void begin_in_given_map() noexcept {
    frames_ = 1;
    given_ = true;
  }
  // One more frame is lost. A covered lens says nothing about the map; an image that shows enough and does
  // not fit does.
  void add(const Frame<S>& frame) noexcept {
    ++frames_;
    if (static_cast<int>(frame.points.size() + frame.lines.size()) >= telling_features) ++unfit_;
  }
  void end() noexcept { frames_ = unfit_ = 0; }

  [[nodiscard]] bool refutes(const Map<S>& map) const noexcept {
    return unfit_ >= give_up_after && !given_ && static_cast<int>(map.keyframes.size()) < young_map;
  }

 private:
  int frames_ = 0;  // in a row
  int unfit_ = 0;   // of them, those that showed enough to be recognised
  bool given_ = false;
};

}  // namespace sslam
