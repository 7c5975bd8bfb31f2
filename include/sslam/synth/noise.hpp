// SPDX-License-Identifier: BSD-3-Clause
// Lattice hashes, value noise and normal quantiles: the raw material of textures and sensor noise.
#pragma once

#include <cmath>
#include <cstdint>

namespace sslam::synth {

// A well mixed 32-bit hash of a lattice point; the same on every machine.
[[nodiscard]] constexpr std::uint32_t lattice_hash(int x, int y, std::uint32_t seed) noexcept {
  std::uint32_t h = seed * 0x9E3779B1u + static_cast<std::uint32_t>(x) * 0x85EBCA77u +
                    static_cast<std::uint32_t>(y) * 0xC2B2AE3Du;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return h ^ (h >> 15);
}

// Uniform in [0, 1) per lattice point.
[[nodiscard]] constexpr float lattice_value(int x, int y, std::uint32_t seed) noexcept {
  return static_cast<float>(lattice_hash(x, y, seed) >> 8) * 0x1.0p-24f;
}

[[nodiscard]] constexpr float smooth_step(float low, float high, float x) noexcept {
  const float a = x <= low ? 0.0f : x >= high ? 1.0f : (x - low) / (high - low);
  return a * a * (3.0f - 2.0f * a);
}

// Smooth value noise in [0, 1], lattice spacing 1.
[[nodiscard]] inline float value_noise(float x, float y, std::uint32_t seed) noexcept {
  const float bx = std::floor(x), by = std::floor(y);
  const int ix = static_cast<int>(bx), iy = static_cast<int>(by);
  const float fx = smooth_step(0.0f, 1.0f, x - bx), fy = smooth_step(0.0f, 1.0f, y - by);
  const float a = lattice_value(ix, iy, seed), b = lattice_value(ix + 1, iy, seed);
  const float c = lattice_value(ix, iy + 1, seed), d = lattice_value(ix + 1, iy + 1, seed);
  const float top = a + fx * (b - a), bottom = c + fx * (d - c);
  return top + fy * (bottom - top);
}

// Octaves of value noise, each twice as fine and `gain` times as strong as the one before; in [0, 1], mean
// 0.5.
[[nodiscard]] inline float octave_noise(float x, float y, int octaves, float gain,
                                        std::uint32_t seed) noexcept {
  float sum = 0.0f, total = 0.0f, weight = 1.0f;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * value_noise(x, y, seed + static_cast<std::uint32_t>(i));
    total += weight;
    weight *= gain;
    x *= 2.03f;
    y *= 2.03f;
  }
  return sum / total;
}

// Where the standard normal distribution reaches the given probability, by bisection.
[[nodiscard]] inline double normal_quantile(double probability) noexcept {
  double low = -6.0, high = 6.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < probability ? low : high) = middle;
  }
  return low;
}

}  // namespace sslam::synth
