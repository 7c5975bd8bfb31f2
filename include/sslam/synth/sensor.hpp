// SPDX-License-Identifier: BSD-3-Clause
// From display values to the 8-bit image of a camera: exposure, vignetting and seeded noise.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/synth/noise.hpp"
#include "sslam/synth/rendered_frame.hpp"
#include "sslam/synth/slow_drift.hpp"

namespace sslam::synth {

struct SensorOptions {
  float noise = 1.5f;                // standard deviation, grey levels
  float vignetting = 0.12f;          // loss of display value in the corners
  float exposure_swing = 0.0f;       // the largest step of exposure, as a share of the display value
  float exposure_hold = 1.5f;        // seconds between two steps
  float exposure_drift = 0.0f;       // how far the exposure wanders, as a share of the display value
  float white_balance_drift = 0.0f;  // how far red wanders up as blue goes down, as a share
};

class Sensor {
 public:
  Sensor(const SensorOptions& options, std::uint64_t seed)
      : options_(options), seed_(seed), brightness_(8.0, 30.0, seed + 78), warmth_(15.0, 60.0, seed + 79) {
    for (int i = 0; i < kLevels; ++i) normal_[i] = static_cast<float>(normal_quantile((i + 0.5) / kLevels));
  }

  // 8-bit values, 3 per pixel, in the order of the frame. The noise depends on the seed and the frame's
  // number alone. Most of it is shared by the channels, as after demosaicing.
  void expose(const RenderedFrame& frame, int number, double seconds, std::vector<std::uint8_t>& out) const {
    out.resize(frame.rgb.size());
    const float drift = options_.exposure_drift * static_cast<float>(brightness_.at(seconds));
    const float gain = 255.0f * exposure(seconds) * (1.0f + drift);
    const float warmth = options_.white_balance_drift * static_cast<float>(warmth_.at(seconds));
    const std::array<float, 3> balance{1.0f + warmth, 1.0f, 1.0f - warmth};
    const float cx = 0.5f * static_cast<float>(frame.width - 1),
                cy = 0.5f * static_cast<float>(frame.height - 1);
    const float fall = options_.vignetting / (cx * cx + cy * cy);
    const float shared = 0.85f * options_.noise, own = 0.53f * options_.noise;
    Random random(seed_ ^ (0xD1B54A32D192ED03ULL * static_cast<std::uint64_t>(number + 1)));
    std::size_t i = 0;
    for (int y = 0; y < frame.height; ++y) {
      const float dy = static_cast<float>(y) - cy;
      for (int x = 0; x < frame.width; ++x) {
        const float dx = static_cast<float>(x) - cx;
        const float level = gain * (1.0f - fall * (dx * dx + dy * dy));
        const std::uint64_t bits = random.next();
        const float common = shared * normal_[bits % kLevels] + 0.5f;
        for (int c = 0; c < 3; ++c, ++i) {
          const float value = frame.rgb[i] * (level * balance[c]) + common +
                              own * normal_[bits >> (12 * (c + 1)) & (kLevels - 1)];
          out[i] = static_cast<std::uint8_t>(std::clamp(value, 0.0f, 255.0f));
        }
      }
    }
  }

 private:
  static constexpr int kLevels = 4096;

  // A random factor that holds for a while and then slides to the next within 0.2 s.
  [[nodiscard]] float exposure(double seconds) const {
    const double step = seconds / options_.exposure_hold;
    const auto factor = [&](double index) {
      Random random(seed_ + 77 + static_cast<std::uint64_t>(index));
      return 1.0f + options_.exposure_swing * random.uniform(-1.0f, 1.0f);
    };
    const double index = std::floor(step);
    const float slide = static_cast<float>(std::min((step - index) * options_.exposure_hold / 0.2, 1.0));
    if (index < 1.0) return factor(0.0);
    return factor(index - 1.0) + slide * (factor(index) - factor(index - 1.0));
  }

  SensorOptions options_;
  std::uint64_t seed_;
  SlowDrift brightness_, warmth_;
  std::array<float, kLevels> normal_;
};

}  // namespace sslam::synth
