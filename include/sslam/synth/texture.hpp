// SPDX-License-Identifier: BSD-3-Clause
// A mipmapped 8-bit texture measured in metres, read with trilinear filtering and a few probes along the long
// axis of the pixel's footprint: far and grazing surfaces lose detail as they do in a camera, without
// shimmer. It is baked when a camera first looks at it: most of a house is never seen by a short walk.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "sslam/core/types.hpp"

namespace sslam::synth {

// How far (s, t), in metres, moves on the surface for one pixel to the right (du) and one pixel down (dv).
struct Footprint {
  Vec2<float> du, dv;
};

class Texture {
 public:
  using Texel = std::function<void(float, float, float*)>;

  // texel(s, t, out) writes `channels` values in [0, 1] for the point (s, t) in metres. It is called later,
  // by one thread, so it keeps what it needs.
  static Texture bake(float width_m, float height_m, float texel_m, int channels, Texel texel) {
    Texture texture(channels, texel_m);
    texture.width_ = std::max(2, static_cast<int>(std::ceil(width_m / texel_m)));
    texture.height_ = std::max(2, static_cast<int>(std::ceil(height_m / texel_m)));
    texture.baked_->texel = std::move(texel);
    return texture;
  }

  [[nodiscard]] int channels() const noexcept { return channels_; }
  [[nodiscard]] float width() const noexcept { return static_cast<float>(width_) * texel_m_; }
  [[nodiscard]] float height() const noexcept { return static_cast<float>(height_) * texel_m_; }

  // Filtered value at (s, t) metres, in [0, 1] per channel; the border repeats outwards. From any thread.
  void sample(float s, float t, const Footprint& footprint, float* out) const {
    const std::vector<Level>& levels = baked();
    const float lu = footprint.du.norm(), lv = footprint.dv.norm();
    const Vec2<float>& major = lu > lv ? footprint.du : footprint.dv;
    const float longer = std::max(lu, lv), shorter = std::max(std::min(lu, lv), 1e-6f);
    const int probes = std::clamp(static_cast<int>(longer / shorter + 0.5f), 1, kMaxProbes);
    const float width = std::max(longer / static_cast<float>(probes), shorter);
    const float lod = std::clamp(std::log2(width / texel_m_), 0.0f, static_cast<float>(levels.size() - 1));
    std::array<float, 3> sum{};
    for (int i = 0; i < probes; ++i) {
      const float along = (static_cast<float>(i) + 0.5f) / static_cast<float>(probes) - 0.5f;
      trilinear(levels, s + along * major.x(), t + along * major.y(), lod, sum.data());
    }
    for (int c = 0; c < channels_; ++c) out[c] = sum[c] / (255.0f * static_cast<float>(probes));
  }

 private:
  struct Level {
    int width, height;
    std::vector<std::uint8_t> texels;
  };
  struct Baked {
    Texel texel;  // until it is baked
    std::vector<Level> levels;
    std::mutex mutex;
    std::atomic<bool> ready{false};
  };
  static constexpr int kMaxProbes = 6;

  Texture(int channels, float texel_m) : channels_(channels), texel_m_(texel_m) {}

  [[nodiscard]] const std::vector<Level>& baked() const {
    Baked& baked = *baked_;
    if (baked.ready.load(std::memory_order_acquire)) return baked.levels;
    const std::scoped_lock lock(baked.mutex);
    if (baked.levels.empty()) {
      std::vector<Level> levels{finest(baked.texel)};
      while (std::min(levels.back().width, levels.back().height) > 2) levels.push_back(halved(levels.back()));
      baked.levels = std::move(levels);
      baked.texel = {};
      baked.ready.store(true, std::memory_order_release);
    }
    return baked.levels;
  }

  [[nodiscard]] Level finest(const Texel& texel) const {
    Level level{width_, height_, {}};
    level.texels.resize(static_cast<std::size_t>(width_) * height_ * channels_);
    std::uint8_t* out = level.texels.data();
    std::array<float, 3> value{};
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        texel((x + 0.5f) * texel_m_, (y + 0.5f) * texel_m_, value.data());
        for (int c = 0; c < channels_; ++c) {
          *out++ = static_cast<std::uint8_t>(std::clamp(value[c], 0.0f, 1.0f) * 255.0f + 0.5f);
        }
      }
    }
    return level;
  }

  [[nodiscard]] Level halved(const Level& fine) const {
    Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
    coarse.texels.resize(static_cast<std::size_t>(coarse.width) * coarse.height * channels_);
    std::uint8_t* out = coarse.texels.data();
    for (int y = 0; y < coarse.height; ++y) {
      const int y0 = 2 * y, y1 = std::min(2 * y + 1, fine.height - 1);
      for (int x = 0; x < coarse.width; ++x) {
        const int x0 = 2 * x, x1 = std::min(2 * x + 1, fine.width - 1);
        for (int c = 0; c < channels_; ++c) {
          const auto at = [&](int px, int py) -> int {
            return fine.texels[(static_cast<std::size_t>(py) * fine.width + px) * channels_ + c];
          };
          *out++ = static_cast<std::uint8_t>((at(x0, y0) + at(x1, y0) + at(x0, y1) + at(x1, y1) + 2) / 4);
        }
      }
    }
    return coarse;
  }

  void trilinear(const std::vector<Level>& levels, float s, float t, float lod, float* sum) const noexcept {
    const int fine = static_cast<int>(lod);
    const float fraction = lod - static_cast<float>(fine);
    bilinear(levels[fine], s, t, fine, 1.0f - fraction, sum);
    if (fraction > 0.0f) bilinear(levels[fine + 1], s, t, fine + 1, fraction, sum);
  }

  void bilinear(const Level& level, float s, float t, int index, float weight, float* sum) const noexcept {
    const float per_metre = 1.0f / (texel_m_ * static_cast<float>(1 << index));
    const float x = std::clamp(s * per_metre - 0.5f, 0.0f, static_cast<float>(level.width) - 1.001f);
    const float y = std::clamp(t * per_metre - 0.5f, 0.0f, static_cast<float>(level.height) - 1.001f);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    const std::uint8_t* top = &level.texels[(static_cast<std::size_t>(y0) * level.width + x0) * channels_];
    const std::uint8_t* bottom = top + static_cast<std::size_t>(level.width) * channels_;
    for (int c = 0; c < channels_; ++c) {
      const float a = top[c] + fx * (top[c + channels_] - top[c]);
      const float b = bottom[c] + fx * (bottom[c + channels_] - bottom[c]);
      sum[c] += weight * (a + fy * (b - a));
    }
  }

  int channels_;
  float texel_m_;
  int width_ = 0, height_ = 0;  // texels
  std::unique_ptr<Baked> baked_ = std::make_unique<Baked>();
};

}  // namespace sslam::synth
