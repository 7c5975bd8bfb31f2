// SPDX-License-Identifier: BSD-3-Clause
// A value that wanders slowly between -1 and 1.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "sslam/core/random.hpp"

namespace sslam::synth {

class SlowDrift {
 public:
  // Its waves last `shortest` to `longest` seconds.
  SlowDrift(double shortest, double longest, std::uint64_t seed) {
    Random random(seed);
    for (Wave& wave : waves_)
      wave = {random.uniform(shortest, longest), random.uniform(0.0, 2.0 * std::numbers::pi)};
  }

  [[nodiscard]] double at(double seconds) const noexcept {
    double sum = 0.0;
    for (const Wave& wave : waves_)
      sum += std::sin(2.0 * std::numbers::pi * seconds / wave.period + wave.phase);
    return sum / waves_.size();
  }

 private:
  struct Wave {
    double period, phase;
  };
  std::array<Wave, 3> waves_;
};

}  // namespace sslam::synth
