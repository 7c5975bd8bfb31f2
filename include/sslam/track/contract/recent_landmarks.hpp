// SPDX-License-Identifier: BSD-3-Clause
// The landmarks with which a frame is compared first.
#pragma once

#include <algorithm>
#include <vector>

#include "sslam/track/contract/tracked_frame.hpp"

namespace sslam {

// The landmarks seen in the last two frames, each once.
template <Scalar S>
struct RecentLandmarks {
  std::vector<LandmarkId> points;
  std::vector<LandmarkId> lines;

  void gather(const TrackedFrame<S>& last, const TrackedFrame<S>& before) {
    merge(points, last.point_landmarks, before.point_landmarks);
    merge(lines, last.line_landmarks, before.line_landmarks);
  }

 private:
  static void merge(std::vector<LandmarkId>& out, const std::vector<LandmarkId>& a,
                    const std::vector<LandmarkId>& b) {
    out.clear();
    for (const auto* seen : {&a, &b})
      for (const LandmarkId id : *seen)
        if (id != kNone) out.push_back(id);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
  }
};

}  // namespace sslam
