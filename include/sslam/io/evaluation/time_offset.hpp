// SPDX-License-Identifier: BSD-3-Clause
// The offset between two clocks, from how the same camera turned and moved by each: turn rates and speeds
// know neither the worlds of the trajectories nor, up to a factor, their units.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "sslam/io/evaluation/motion_rates.hpp"
#include "sslam/io/trajectories/trajectory.hpp"

namespace sslam::io {

struct TimeOffset {
  double offset = 0;    // to add to the stamps of the estimate, in their unit
  double likeness = 0;  // of the motions then: the mean correlation of turn rates and speeds, at most 1
  std::string problem;  // not empty: the motions do not tell
};

namespace time_offset_detail {

using motion_rates::kUnknown;
using motion_rates::Motion;
using motion_rates::motion_of;

// Pearson's correlation of a[i + lag] with b[i]; not a number where fewer than `least` have both.
[[nodiscard]] inline double correlation(const std::vector<double>& a, const std::vector<double>& b,
                                        std::ptrdiff_t lag, double least) {
  const auto first = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, -lag));
  const auto last =
      std::min(static_cast<std::ptrdiff_t>(b.size()), static_cast<std::ptrdiff_t>(a.size()) - lag);
  double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (std::size_t i = first; static_cast<std::ptrdiff_t>(i) < last; ++i) {
    const double x = a[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + lag)], y = b[i];
    if (!std::isfinite(x + y)) continue;
    n += 1;
    sa += x;
    sb += y;
    saa += x * x;
    sbb += y * y;
    sab += x * y;
  }
  if (n < least) return kUnknown;
  const double va = saa - sa * sa / n, vb = sbb - sb * sb / n;
  return va > 0 && vb > 0 ? (sab - sa * sb / n) / std::sqrt(va * vb) : kUnknown;
}

// The likeness at a lag: of those rates that vary in both.
class Likeness {
 public:
  Likeness(const Motion& truth, const Motion& estimate) : truth_(truth), estimate_(estimate) {
    for (std::size_t k = 0; k < 2; ++k)
      used_[k] = motion_rates::varies(truth.rates[k]) && motion_rates::varies(estimate.rates[k]);
    const auto known = [](const std::vector<double>& rates) {
      return std::count_if(rates.begin(), rates.end(), [](double rate) { return std::isfinite(rate); });
    };
    constexpr double kFewest = 20;
    least_ = std::max(kFewest,
                      0.5 * static_cast<double>(std::min(known(truth.rates[0]), known(estimate.rates[0]))));
  }
  [[nodiscard]] bool possible() const noexcept { return used_[0] || used_[1]; }
  [[nodiscard]] double at(std::ptrdiff_t lag) const {
    double sum = 0;
    int count = 0;
    for (std::size_t k = 0; k < 2; ++k)
      if (used_[k]) {
        sum += correlation(truth_.rates[k], estimate_.rates[k], lag, least_);
        ++count;
      }
    return sum / count;
  }

 private:
  const Motion &truth_, &estimate_;
  std::array<bool, 2> used_{};
  double least_ = 0;
};

// The peak near the offset that was found on a grid at most 8 times as wide.
inline void sharpen(const Trajectory& truth, const Trajectory& estimate, double grid, double window,
                    TimeOffset& found) {
  const Motion a = motion_of(truth, grid, window), b = motion_of(estimate, grid, window);
  const Likeness likeness(a, b);
  constexpr std::ptrdiff_t kReach = 16;
  const auto middle = static_cast<std::ptrdiff_t>(std::llround((found.offset - a.start + b.start) / grid));
  std::ptrdiff_t top = middle;
  double highest = kUnknown;
  for (std::ptrdiff_t lag = middle - kReach; lag <= middle + kReach; ++lag)
    if (const double value = likeness.at(lag); std::isfinite(value) && !(highest >= value)) {
      highest = value;
      top = lag;
    }
  if (!std::isfinite(highest)) return;
  // A parabola through the peak and its neighbours.
  const double before = likeness.at(top - 1), after = likeness.at(top + 1);
  const double bend = before - 2 * highest + after;
  const double shift = bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0;
  found.offset = a.start - b.start + (static_cast<double>(top) + shift) * grid;
  found.likeness = highest;
}

}  // namespace time_offset_detail

// Both by increasing stamps in one unit. Half of the shorter one must lie within the other.
[[nodiscard]] inline TimeOffset find_time_offset(const Trajectory& truth, const Trajectory& estimate) {
  using namespace time_offset_detail;
  constexpr std::size_t kFewest = 20, kMost = 4000;  // poses; places on the coarse grid
  constexpr double kAlike = 0.6, kOther = 0.9;       // least likeness; of it, that of the best other place
  TimeOffset found;
  if (truth.size() < kFewest || estimate.size() < kFewest) {
    found.problem = "fewer than " + std::to_string(kFewest) + " poses";
    return found;
  }
  const double step = std::max(motion_rates::median_step(truth), motion_rates::median_step(estimate));
  const double longest =
      std::max(truth.back().stamp - truth.front().stamp, estimate.back().stamp - estimate.front().stamp);
  const double coarse = std::max(step / 2, longest / kMost), window = std::max(3 * step, 2 * coarse);
  const Motion coarse_truth = motion_of(truth, coarse, window),
               coarse_estimate = motion_of(estimate, coarse, window);
  const Likeness likeness(coarse_truth, coarse_estimate);
  if (!likeness.possible()) {
    found.problem = "neither turn rate nor speed changes enough";
    return found;
  }
  const auto from = -static_cast<std::ptrdiff_t>(coarse_estimate.rates[0].size());
  const auto to = static_cast<std::ptrdiff_t>(coarse_truth.rates[0].size());
  std::vector<double> values;
  for (std::ptrdiff_t lag = from; lag <= to; ++lag) values.push_back(likeness.at(lag));
  std::size_t best = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i]) && !(values[best] >= values[i])) best = i;
  if (!(values[best] >= kAlike)) {
    found.problem = "the motions are not alike at any offset";
    return found;
  }
  // One peak alone, and no plateau, may be that high.
  const double high = kOther * values[best];
  std::size_t left = best, right = best;
  while (left > 0 && values[left - 1] > high) --left;
  while (right + 1 < values.size() && values[right + 1] > high) ++right;
  constexpr double kPlateau = 0.1;  // of the longer recording
  bool repeats = static_cast<double>(right - left) * coarse > kPlateau * longest;
  for (std::size_t i = 0; i < values.size(); ++i)
    repeats = repeats || ((i < left || i > right) && values[i] > high);
  if (repeats) {
    found.problem = "the motion repeats itself, or hardly changes: other offsets fit nearly as well";
    return found;
  }
  found.offset = coarse_truth.start - coarse_estimate.start +
                 (static_cast<double>(best) + static_cast<double>(from)) * coarse;
  for (double grid = coarse; grid > step / 16;) {
    grid = std::max(grid / 8, step / 16);
    sharpen(truth, estimate, grid, std::max(3 * step, 4 * grid), found);
  }
  return found;
}

}  // namespace sslam::io
