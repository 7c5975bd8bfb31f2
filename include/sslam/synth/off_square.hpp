// SPDX-License-Identifier: BSD-3-Clause
// Walls and furniture that are off square by some degrees, as those of real rooms are.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sslam/core/random.hpp"
#include "sslam/synth/noise.hpp"
#include "sslam/synth/outline.hpp"

namespace sslam::synth {

inline constexpr double kMostOffSquare = 8.0;  // degrees: walls beyond could leave no room

// Seeded angles of a normal distribution whose tails are cut off 2.62 standard deviations from the middle.
class OffSquare {
 public:
  OffSquare(double degrees, std::uint64_t seed) : spread_(radians(degrees)), random_(seed) {}

  // Radians; 0 without a draw where nothing is off square.
  [[nodiscard]] double angle() noexcept {
    if (spread_ == 0.0) return 0.0;
    // Cut at 2.5 of the full normal distribution, what is left has a standard deviation of 0.9546.
    constexpr double kTail = 0.00620967, kLeft = 0.9546;
    return spread_ / kLeft * normal_quantile(random_.uniform(kTail, 1.0 - kTail));
  }

 private:
  double spread_;
  Random random_;
};

// Turns each edge about its middle by an angle of its own; corners are where neighbours meet.
[[nodiscard]] inline Outline turned_edges(const Outline& corners, OffSquare& off) {
  struct Line {
    Vec2<double> middle, along;
  };
  std::vector<Line> lines;
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2<double> run = corners[(i + 1) % n] - corners[i];
    const double heading = std::atan2(run.y(), run.x()) + off.angle();
    lines.push_back({corners[i] + 0.5 * run, {std::cos(heading), std::sin(heading)}});
  }
  Outline turned;
  for (std::size_t i = 0; i < n; ++i) {
    const Line &before = lines[(i + n - 1) % n], &after = lines[i];
    const Vec2<double> gap = after.middle - before.middle;
    const double cross = before.along.x() * after.along.y() - before.along.y() * after.along.x();
    const double reach = (gap.x() * after.along.y() - gap.y() * after.along.x()) / cross;
    turned.push_back(before.middle + reach * before.along);
  }
  return turned;
}

}  // namespace sslam::synth
