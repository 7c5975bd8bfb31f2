// SPDX-License-Identifier: BSD-3-Clause
// Frames that had drifted before it was noticed. Their poses are wrong, and so is what the map has from them:
// both are withdrawn after the last frame, so that the final pass tracks these frames anew, from either side.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "sslam/track/worlds/trajectory_log.hpp"

namespace sslam {

class DriftedFrames {
 public:
  // Stamps of the last frame that is not in doubt, and of the one that was lost for its drift.
  void add(double after, double until) { ranges_.emplace_back(after, until); }

  [[nodiscard]] bool contains(double stamp) const {
    return std::any_of(ranges_.begin(), ranges_.end(),
                       [&](const auto& range) { return range.first < stamp && stamp <= range.second; });
  }

  // Each drift is withdrawn once. True if the map or the log had any of its frames. The first two keyframes
  // stay: they hold place and scale. What hangs on a keyframe that goes is carried on by the one before it.
  template <Scalar S>
  bool withdraw(Map<S>& map, TrajectoryLog<S>& log) {
    if (ranges_.empty()) return false;
    KeyframeId before = kNone;
    bool any = false;
    for (std::size_t k = 0; k < map.keyframes.size(); ++k) {
      const auto id = static_cast<KeyframeId>(k);
      if (!map.keyframes[k].alive()) continue;
      if (id >= 2 && contains(map.keyframes[k].frame.stamp)) {
        map.erase_keyframe(id, before);
        any = true;
      } else {
        before = id;
      }
    }
    any = log.withdraw([&](const auto& entry) { return contains(entry.stamp); }) > 0 || any;
    ranges_.clear();
    return any;
  }

 private:
  std::vector<std::pair<double, double>> ranges_;
};

}  // namespace sslam
