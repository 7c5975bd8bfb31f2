// SPDX-License-Identifier: BSD-3-Clause
// Printed things in colour: posters with random shapes and lines of text-like marks, rows of book spines, and
// the blurred view out of a window.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sslam/core/random.hpp"
#include "sslam/synth/noise.hpp"
#include "sslam/synth/texture.hpp"

namespace sslam::synth {

[[nodiscard]] inline Vec3<float> random_colour(Random& random, float low, float high) noexcept {
  return {random.uniform(low, high), random.uniform(low, high), random.uniform(low, high)};
}

// One printed shape: a disc, a ring or a rotated rectangle with soft edges of about a texel.
struct PrintedShape {
  enum Kind { kDisc, kRing, kRectangle } kind;
  Vec2<float> centre, half;  // metres; a disc has radius half.x
  float cosine, sine;
  Vec3<float> colour;

  // 1 inside, 0 outside, between the two over `soft` metres.
  [[nodiscard]] float coverage(float s, float t, float soft) const noexcept {
    const float ds = s - centre.x(), dt = t - centre.y();
    float signed_distance;
    if (kind == kRectangle) {
      const float x = std::abs(cosine * ds + sine * dt) - half.x();
      const float y = std::abs(-sine * ds + cosine * dt) - half.y();
      signed_distance = std::max(x, y);
    } else {
      signed_distance = std::sqrt(ds * ds + dt * dt) - half.x();
      if (kind == kRing) signed_distance = std::max(signed_distance, -signed_distance - half.y());
    }
    return 1.0f - smooth_step(-0.5f * soft, 0.5f * soft, signed_distance);
  }
};

[[nodiscard]] inline PrintedShape random_shape(Random& random, float width_m, float height_m) {
  const float angle = random.uniform(0.0f, 3.14159f);
  const float size = 0.5f * std::min(width_m, height_m);
  PrintedShape shape{static_cast<PrintedShape::Kind>(random.below(3)),
                     {random.uniform(0.1f, 0.9f) * width_m, random.uniform(0.1f, 0.9f) * height_m},
                     {size * random.uniform(0.08f, 0.6f), size * random.uniform(0.05f, 0.4f)},
                     std::cos(angle),
                     std::sin(angle),
                     random_colour(random, 0.05f, 0.95f)};
  if (random.below(2) == 0) shape.cosine = 1.0f, shape.sine = 0.0f;
  return shape;
}

// Letter-like marks: a random 3 x 5 bitmap per character cell, words of random length, ragged lines.
[[nodiscard]] inline float text_ink(float s, float t, float height_m, std::uint32_t seed) noexcept {
  const float line = t / (1.7f * height_m), column = s / (0.75f * height_m);
  const int row = static_cast<int>(std::floor(line)), place = static_cast<int>(std::floor(column));
  const float y = (line - static_cast<float>(row)) * 1.7f, x = column - static_cast<float>(place);
  if (y > 1.0f || x > 0.8f) return 0.0f;
  if (lattice_value(place, row, seed) < 0.17f || lattice_value(row, 7, seed + 1) < 0.1f) return 0.0f;
  const int bit = static_cast<int>(x / 0.8f * 3.0f) + 3 * static_cast<int>(std::min(y, 0.999f) * 5.0f);
  const std::uint32_t glyph = lattice_hash(place, row, seed + 2) | lattice_hash(place, row, seed + 3) % 512u;
  return (glyph >> bit) & 1u ? 1.0f : 0.0f;
}

// A poster: paper, shapes, and a block of text along the lower edge.
[[nodiscard]] inline Texture bake_poster(float width_m, float height_m, float texel_m, std::uint32_t seed) {
  Random random(seed);
  const Vec3<float> paper = random_colour(random, 0.55f, 0.98f);
  const Vec3<float> ink = random_colour(random, 0.02f, 0.3f);
  std::vector<PrintedShape> shapes(6 + random.below(10));
  for (PrintedShape& shape : shapes) shape = random_shape(random, width_m, height_m);
  const float letter = random.uniform(0.018f, 0.035f);
  const float block = random.uniform(0.15f, 0.4f) * height_m;
  const float margin = 0.06f * width_m;
  return Texture::bake(width_m, height_m, texel_m, 3, [=](float s, float t, float* out) {
    Vec3<float> colour = paper;
    for (const PrintedShape& shape : shapes) {
      colour += shape.coverage(s, t, 2.0f * texel_m) * (shape.colour - colour);
    }
    const bool in_text = s > margin && s < width_m - margin && t > margin && t < block;
    if (in_text) colour += 0.85f * (paper - colour);
    if (in_text) colour += text_ink(s, t, letter, seed) * (ink - colour);
    if (std::min({s, t, width_m - s, height_m - t}) < 0.012f) colour = ink;
    std::copy_n(Vec3<float>(colour).data(), 3, out);
  });
}

// Upright book spines of random width, height and colour with a label each.
[[nodiscard]] inline Texture bake_books(float width_m, float height_m, float texel_m, std::uint32_t seed) {
  Random random(seed);
  struct Spine {
    float end, top, label;
    Vec3<float> colour, label_colour;
  };
  std::vector<Spine> spines;
  for (float s = 0.0f; s < width_m;) {
    s += random.uniform(0.018f, 0.055f);
    spines.push_back({s, height_m * random.uniform(0.65f, 0.97f), random.uniform(0.4f, 0.8f),
                      random_colour(random, 0.08f, 0.8f), random_colour(random, 0.3f, 1.0f)});
  }
  return Texture::bake(width_m, height_m, texel_m, 3, [=](float s, float t, float* out) {
    std::size_t i = 0;
    while (i + 1 < spines.size() && s > spines[i].end) ++i;
    const Spine& spine = spines[i];
    Vec3<float> colour = spine.colour;
    const float start = i == 0 ? 0.0f : spines[i - 1].end;
    if (std::abs(t / spine.top - spine.label) < 0.08f) colour = spine.label_colour;
    if (text_ink(t, s - start - 0.006f, 0.014f, seed + static_cast<std::uint32_t>(i)) > 0.0f &&
        t < 0.5f * spine.top) {
      colour = spine.label_colour;
    }
    if (std::min(s - start, spine.end - s) < 0.0015f) colour *= 0.4f;
    if (t > spine.top) colour = Vec3<float>::Constant(0.06f);
    std::copy_n(Vec3<float>(colour).data(), 3, out);
  });
}

// Sky over a soft skyline.
[[nodiscard]] inline Texture bake_outdoors(float width_m, float height_m, float texel_m, std::uint32_t seed) {
  return Texture::bake(width_m, height_m, texel_m, 3, [=](float s, float t, float* out) {
    const float skyline = height_m * (0.25f + 0.3f * value_noise(2.5f * s, 0.5f, seed));
    const float sky = smooth_step(skyline - 0.04f, skyline + 0.04f, t);
    const float cloud = octave_noise(1.5f * s, 3.0f * t, 4, 0.5f, seed + 1);
    const float leaves = octave_noise(9.0f * s, 9.0f * t, 3, 0.6f, seed + 2);
    const Vec3<float> up = Vec3<float>(0.72f, 0.84f, 0.95f) + 0.22f * cloud * Vec3<float>(1.0f, 0.7f, 0.2f);
    const Vec3<float> down = Vec3<float>(0.3f, 0.42f, 0.25f) + 0.3f * leaves * Vec3<float>::Ones();
    std::copy_n(Vec3<float>(down + sky * (up - down)).data(), 3, out);
  });
}

}  // namespace sslam::synth
