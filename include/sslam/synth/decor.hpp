// SPDX-License-Identifier: BSD-3-Clause
// Chooses paints: how much there is to see on walls, floors and furniture.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "sslam/core/random.hpp"
#include "sslam/synth/pattern.hpp"
#include "sslam/synth/poster.hpp"
#include "sslam/synth/scene.hpp"

namespace sslam::synth {

enum class Richness : std::uint8_t {
  kRich,   // every surface carries a texture, posters on the walls
  kMixed,  // each surface by chance
  kPoor,   // plain paint alone
};

class Decor {
 public:
  Decor(Scene& scene, Richness richness, float texel_m, std::uint64_t seed)
      : scene_(scene), richness_(richness), texel_m_(texel_m), random_(seed) {
    wall_ = tone(0.72f, 0.9f, 0.04f);
    floor_ = tone(0.42f, 0.62f, 0.07f);
    trim_ = random_.below(2) == 0 ? plain(0.3f, 0.5f) : plain(0.8f, 0.95f);
  }

  [[nodiscard]] bool textured() {
    return richness_ == Richness::kRich || (richness_ == Richness::kMixed && random_.below(2) == 0);
  }

  // One wall of width x height metres.
  Paint wall(float width, float height) {
    constexpr std::array kPatterns{Pattern::kSpeckle, Pattern::kBricks, Pattern::kStripes, Pattern::kPlaster,
                                   Pattern::kSpeckle};
    if (!textured()) return {wall_};
    const Pattern pattern = kPatterns[random_.below(kPatterns.size())];
    Paint paint =
        tinted(pattern == Pattern::kBricks ? 0.6f : 0.72f, 0.1f, pattern == Pattern::kPlaster ? 0.3f : 0.5f);
    paint.texture = scene_.add(bake_pattern(pattern, width, height, texel_m_, bits()));
    return paint;
  }

  Paint floor(float width, float height) {
    constexpr std::array kPatterns{Pattern::kPlanks, Pattern::kTiles, Pattern::kCarpet};
    if (!textured()) return {floor_};
    Paint paint = tinted(0.5f, 0.12f, 0.55f);
    const std::uint32_t seed = bits();
    const Pattern pattern = kPatterns[random_.below(kPatterns.size())];
    paint.texture = scene_.add(bake_pattern(pattern, width, height, 1.4f * texel_m_, seed));
    return paint;
  }

  Paint ceiling() { return {Vec3<float>::Constant(random_.uniform(0.85f, 0.95f))}; }

  // Wood or lacquer for one piece of furniture; pieces share a few sheets of wood.
  Paint furniture() {
    if (!textured()) return plain(0.3f, 0.9f);
    if (sheets_.empty() || (sheets_.size() < 3 && random_.below(2) == 0)) {
      const Pattern pattern = sheets_.size() == 1 ? Pattern::kSpeckle : Pattern::kWood;
      sheets_.push_back(scene_.add(bake_pattern(pattern, kSheet, kSheet, 0.8f * texel_m_, bits())));
    }
    Paint paint = tinted(random_.uniform(0.4f, 0.7f), 0.14f, 0.4f);
    paint.texture = sheets_[random_.below(static_cast<std::uint32_t>(sheets_.size()))];
    return shifted(paint);
  }

  // The same sheet at another place, so that two faces do not show the same knots.
  Paint shifted(Paint paint) {
    if (paint.texture >= 0) paint.offset = {random_.uniform(0.0f, 0.5f), random_.uniform(0.0f, 0.3f)};
    return paint;
  }

  // In a poor house everything comes close to the colour of the walls.
  Paint plain(float low, float high) {
    const Vec3<float> colour = tone(low, high, 0.1f);
    if (richness_ != Richness::kPoor) return {colour};
    return {wall_ + 0.45f * (colour - wall_)};
  }

  Paint poster(float width, float height) { return printed(bake_poster(width, height, 0.002f, bits())); }
  Paint books(float width, float height) { return printed(bake_books(width, height, 0.002f, bits())); }
  // What a window shows: the sky alone, overexposed, from a poor house.
  Paint outdoors(float width, float height) {
    Paint paint = {Vec3<float>::Constant(0.95f)};
    if (richness_ != Richness::kPoor) paint = printed(bake_outdoors(width, height, 0.01f, bits()));
    paint.glows = true;
    return paint;
  }

  [[nodiscard]] const Paint& trim() const noexcept { return trim_; }
  [[nodiscard]] Random& random() noexcept { return random_; }

 private:
  static constexpr float kSheet = 2.4f;  // metres

  std::uint32_t bits() { return static_cast<std::uint32_t>(random_.next() >> 32); }

  // A grey between low and high with a little colour.
  Vec3<float> tone(float low, float high, float colour) {
    const float grey = random_.uniform(low, high);
    return Vec3<float>::Constant(grey) + colour * random_colour(random_, -1.0f, 1.0f);
  }

  Paint tinted(float grey, float colour, float contrast) {
    Paint paint{tone(grey - 0.06f, grey + 0.06f, colour)};
    paint.swing = contrast * (paint.colour + 0.2f * random_colour(random_, -1.0f, 1.0f)).cwiseMax(0.2f);
    return paint;
  }

  Paint printed(Texture texture) {
    Paint paint;
    paint.texture = scene_.add(std::move(texture));
    return paint;
  }

  Scene& scene_;
  Richness richness_;
  float texel_m_;
  Random random_;
  Vec3<float> wall_, floor_;
  Paint trim_;
  std::vector<int> sheets_;
};

}  // namespace sslam::synth
