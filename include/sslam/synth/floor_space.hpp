// SPDX-License-Identifier: BSD-3-Clause
// What of the floor is taken: the way of the camera, and what stands there.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "sslam/synth/outline.hpp"

namespace sslam::synth {

// A rectangle on the floor at any heading.
struct FloorArea {
  Placement place;
  Vec2<double> low, high;  // in the placement's frame

  // a and b from 0 to 1, from the low to the high corner.
  [[nodiscard]] Vec2<double> at(double a, double b) const {
    return place.point(low.x() + a * (high.x() - low.x()), low.y() + b * (high.y() - low.y()), 0.0).head<2>();
  }
  [[nodiscard]] double distance(const Vec2<double>& p) const {
    const Vec2<double> d = p - place.at;
    const Vec2<double> local(place.x_axis().head<2>().dot(d), place.y_axis().head<2>().dot(d));
    return (local - local.cwiseMax(low).cwiseMin(high)).norm();
  }
};

class FloorSpace {
 public:
  // walked: places of the camera, seen from above.
  explicit FloorSpace(std::vector<Vec2<double>> walked) : walked_(std::move(walked)) {}

  // Clear of the path and of all that stands on the floor.
  [[nodiscard]] bool free(const FloorArea& area) const {
    for (const Vec2<double>& p : walked_) {
      if (area.distance(p) < kClearance) return false;
    }
    return std::none_of(taken_.begin(), taken_.end(),
                        [&](const FloorArea& other) { return overlap(area, other) || overlap(other, area); });
  }
  void take(const FloorArea& area) { taken_.push_back(area); }

 private:
  static constexpr double kClearance = 0.45;  // from the path, metres

  static bool overlap(const FloorArea& a, const FloorArea& b) {
    for (int i = 0; i <= 8; ++i) {
      for (int k = 0; k <= 4; ++k) {
        if (a.distance(b.at(i / 8.0, k / 4.0)) < 0.06) return true;
      }
    }
    return false;
  }

  std::vector<Vec2<double>> walked_;
  std::vector<FloorArea> taken_;
};

// True when the area reaches through a wall, or in front of one of its openings.
[[nodiscard]] inline bool pierces(const FloorArea& f, const Wall& wall) {
  for (int i = 0; i < 4; ++i) {
    const Vec2<double> d = f.at(i & 1, i >> 1) - wall.place.at;
    const double along = wall.place.x_axis().head<2>().dot(d), out = wall.place.y_axis().head<2>().dot(d);
    if (along < -0.2 || along > wall.length + 0.2 || out > 0.5) continue;
    if (out < 0.03 && out > -0.6) return true;
    for (const Opening& o : wall.openings) {
      if (along > o.left - 0.1 && along < o.right + 0.1) return true;
    }
  }
  return false;
}

}  // namespace sslam::synth
