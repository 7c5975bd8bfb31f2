// SPDX-License-Identifier: BSD-3-Clause
// Procedural surfaces as one grey value in [0, 1] (mean about 0.5) per point in metres: plaster, wallpaper,
// wood, tiles, bricks, carpet. A paint turns the value into a colour.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sslam/synth/noise.hpp"
#include "sslam/synth/texture.hpp"

namespace sslam::synth {

enum class Pattern : std::uint8_t { kPlaster, kSpeckle, kWood, kPlanks, kTiles, kBricks, kStripes, kCarpet };

// Distance from x to the nearest multiple of the period.
[[nodiscard]] inline float to_multiple(float x, float period) noexcept {
  return std::abs(x - period * std::round(x / period));
}

[[nodiscard]] inline float plaster(float s, float t, std::uint32_t seed) noexcept {
  const float broad = octave_noise(1.3f * s, 1.3f * t, 3, 0.6f, seed);
  const float grain = octave_noise(45.0f * s, 45.0f * t, 3, 0.8f, seed + 10);
  return 0.5f + 0.7f * (broad - 0.5f) + 0.9f * (grain - 0.5f);
}

// Stains and dots of many sizes: each cell of three grids holds at most one soft disc.
[[nodiscard]] inline float speckle(float s, float t, std::uint32_t seed) noexcept {
  float value = 0.45f + 0.5f * (octave_noise(6.0f * s, 6.0f * t, 4, 0.7f, seed) - 0.5f);
  float cell = 0.05f;
  for (std::uint32_t layer = 1; layer <= 3; ++layer, cell *= 2.3f) {
    const int cx = static_cast<int>(std::floor(s / cell)), cy = static_cast<int>(std::floor(t / cell));
    const std::uint32_t key = seed + 100 * layer;
    if (lattice_value(cx, cy, key) > 0.45f) continue;
    const float radius = cell * (0.12f + 0.2f * lattice_value(cx, cy, key + 1));
    const float dx = s - cell * (static_cast<float>(cx) + 0.35f + 0.3f * lattice_value(cx, cy, key + 2));
    const float dy = t - cell * (static_cast<float>(cy) + 0.35f + 0.3f * lattice_value(cx, cy, key + 3));
    const float inside = 1.0f - smooth_step(radius - 0.003f, radius + 0.003f, std::sqrt(dx * dx + dy * dy));
    value += inside * (lattice_value(cx, cy, key + 4) - 0.5f) * 1.1f;
  }
  return value;
}

// Grain that runs along t.
[[nodiscard]] inline float wood(float s, float t, std::uint32_t seed) noexcept {
  const float warp = octave_noise(1.5f * s, 0.8f * t, 3, 0.5f, seed);
  const float rings = 0.5f + 0.5f * std::sin(55.0f * s + 14.0f * warp);
  const float fibre = octave_noise(160.0f * s, 5.0f * t, 3, 0.7f, seed + 20);
  return 0.2f + 0.25f * rings + 0.35f * fibre + 0.2f * warp;
}

[[nodiscard]] inline float planks(float s, float t, std::uint32_t seed) noexcept {
  constexpr float kWide = 0.14f, kLong = 1.3f;
  const int row = static_cast<int>(std::floor(s / kWide));
  const float shifted = t + kLong * lattice_value(row, 0, seed);
  const int column = static_cast<int>(std::floor(shifted / kLong));
  const std::uint32_t own = lattice_hash(row, column, seed + 1);
  const float gap = std::min(to_multiple(s, kWide), to_multiple(shifted, kLong));
  const float body = wood(s, t + static_cast<float>(own % 97), seed + own % 5) * 0.7f +
                     0.35f * static_cast<float>(own % 251) / 251.0f - 0.03f;
  return body * (0.35f + 0.65f * smooth_step(0.001f, 0.004f, gap));
}

[[nodiscard]] inline float tiles(float s, float t, std::uint32_t seed) noexcept {
  constexpr float kSide = 0.3f;
  const float joint = std::min(to_multiple(s, kSide), to_multiple(t, kSide));
  const int x = static_cast<int>(std::floor(s / kSide)), y = static_cast<int>(std::floor(t / kSide));
  const float cloud =
      octave_noise(9.0f * s + 31.0f * lattice_value(x, y, seed), 9.0f * t, 4, 0.65f, seed + 1);
  const float body = 0.35f + 0.25f * lattice_value(x, y, seed + 2) + 0.4f * (cloud - 0.25f);
  return 0.1f + (body - 0.1f) * smooth_step(0.002f, 0.005f, joint);
}

[[nodiscard]] inline float bricks(float s, float t, std::uint32_t seed) noexcept {
  constexpr float kWide = 0.25f, kHigh = 0.08f;
  const int row = static_cast<int>(std::floor(t / kHigh));
  const float shifted = s + (row & 1 ? 0.5f * kWide : 0.0f);
  const int column = static_cast<int>(std::floor(shifted / kWide));
  const float mortar = std::min(to_multiple(shifted, kWide), to_multiple(t, kHigh));
  const float ragged = 0.002f * octave_noise(60.0f * s, 60.0f * t, 2, 0.6f, seed + 7);
  const float grain = octave_noise(40.0f * s, 40.0f * t, 3, 0.7f, seed + 8);
  const float body = 0.15f + 0.4f * lattice_value(column, row, seed) + 0.35f * (grain - 0.5f);
  return 0.85f + (body - 0.85f) * smooth_step(0.003f, 0.006f, mortar - ragged);
}

[[nodiscard]] inline float stripes(float s, float t, std::uint32_t seed) noexcept {
  constexpr float kPeriod = 0.22f;
  const float edge = to_multiple(s, kPeriod) - 0.25f * kPeriod;
  const float band = smooth_step(-0.0015f, 0.0015f, edge);
  return 0.3f + 0.35f * band + 0.35f * (octave_noise(25.0f * s, 25.0f * t, 4, 0.8f, seed) - 0.5f);
}

[[nodiscard]] inline float carpet(float s, float t, std::uint32_t seed) noexcept {
  const float tuft = octave_noise(60.0f * s, 60.0f * t, 3, 0.9f, seed);
  const float worn = octave_noise(2.0f * s, 2.0f * t, 3, 0.6f, seed + 5);
  return 0.5f + 1.1f * (tuft - 0.5f) + 0.5f * (worn - 0.5f);
}

[[nodiscard]] inline float evaluate(Pattern pattern, float s, float t, std::uint32_t seed) noexcept {
  switch (pattern) {
    case Pattern::kPlaster:
      return plaster(s, t, seed);
    case Pattern::kSpeckle:
      return speckle(s, t, seed);
    case Pattern::kWood:
      return wood(s, t, seed);
    case Pattern::kPlanks:
      return planks(s, t, seed);
    case Pattern::kTiles:
      return tiles(s, t, seed);
    case Pattern::kBricks:
      return bricks(s, t, seed);
    case Pattern::kStripes:
      return stripes(s, t, seed);
    case Pattern::kCarpet:
      return carpet(s, t, seed);
  }
  return 0.5f;
}

// A one-channel texture of width x height metres.
[[nodiscard]] inline Texture bake_pattern(Pattern pattern, float width_m, float height_m, float texel_m,
                                          std::uint32_t seed) {
  return Texture::bake(width_m, height_m, texel_m, 1,
                       [=](float s, float t, float* out) { out[0] = evaluate(pattern, s, t, seed); });
}

}  // namespace sslam::synth
