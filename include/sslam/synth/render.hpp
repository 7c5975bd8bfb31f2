// SPDX-License-Identifier: BSD-3-Clause
// Renders a scene without noise. Pixels inside a face are shaded once with filtered textures; pixels near an
// edge average 32 points spread like a camera's point spread function, so that an edge lies where geometry
// puts it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sslam/synth/face_view.hpp"
#include "sslam/synth/noise.hpp"
#include "sslam/synth/rendered_frame.hpp"
#include "sslam/synth/scene.hpp"
#include "sslam/synth/visibility.hpp"

namespace sslam::synth {

class Renderer {
 public:
  // The scene must outlive the renderer; its faces must have light maps (bake_lighting).
  explicit Renderer(const Scene& scene) : scene_(scene) {
    for (int i = 0; i < kSamples; ++i) {
      int reversed = 0;
      for (int bit = 0; bit < kBits; ++bit) reversed |= (i >> bit & 1) << (kBits - 1 - bit);
      offsets_[i] = kBlur * Vec2<double>(normal_quantile((i + 0.5) / kSamples),
                                         normal_quantile((reversed + 0.5) / kSamples))
                                .cast<float>();
    }
  }

  void render(const View& view, RenderedFrame& frame) {
    visibility_.find(scene_, view, frame);
    shading_.clear();
    for (const FaceView& face : visibility_.faces()) shading_.push_back(Shading(face));
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * frame.width + x;
        float* out = &frame.rgb[3 * i];
        if (visibility_.mixed(i)) {
          shade_edge(frame, x, y, out);
        } else if (frame.surface[i] >= 0) {
          shade(frame.surface[i], static_cast<float>(x), static_cast<float>(y), out);
        } else {
          out[0] = out[1] = out[2] = 0.0f;
        }
      }
    }
  }

 private:
  // The three forms of a FaceView in single precision.
  struct Shading {
    explicit Shading(const FaceView& view)
        : w(view.inverse.cast<float>()),
          s(view.s_form.cast<float>()),
          t(view.t_form.cast<float>()),
          width(static_cast<float>(view.width)),
          height(static_cast<float>(view.height)),
          face(view.face) {}
    Vec3<float> w, s, t;
    float width, height;
    int face;
  };
  static constexpr int kBits = 5, kSamples = 1 << kBits;
  static constexpr double kBlur = 0.45;  // standard deviation of the point spread function, pixels

  static float light_at(const LightMap& map, float s, float t, float width, float height) noexcept {
    const float x = std::clamp(s / width, 0.0f, 0.9999f) * static_cast<float>(map.columns - 1);
    const float y = std::clamp(t / height, 0.0f, 0.9999f) * static_cast<float>(map.rows - 1);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    const float* top = &map.nodes[static_cast<std::size_t>(y0) * map.columns + x0];
    const float* bottom = top + map.columns;
    const float a = top[0] + fx * (top[1] - top[0]), b = bottom[0] + fx * (bottom[1] - bottom[0]);
    return a + fy * (b - a);
  }

  void shade(int id, float u, float v, float* out) const noexcept {
    const Shading& k = shading_[id];
    const float z = 1.0f / (k.w.x() * u + k.w.y() * v + k.w.z());
    const float s = std::clamp((k.s.x() * u + k.s.y() * v + k.s.z()) * z, 0.0f, k.width);
    const float t = std::clamp((k.t.x() * u + k.t.y() * v + k.t.z()) * z, 0.0f, k.height);
    const Face& face = scene_.faces[k.face];
    const Paint& paint = face.paint;
    std::array<float, 3> colour{paint.colour.x(), paint.colour.y(), paint.colour.z()};
    if (paint.texture >= 0) {
      const Texture& texture = scene_.textures[paint.texture];
      const Footprint footprint{{(k.s.x() - s * k.w.x()) * z, (k.t.x() - t * k.w.x()) * z},
                                {(k.s.y() - s * k.w.y()) * z, (k.t.y() - t * k.w.y()) * z}};
      std::array<float, 3> value{};
      texture.sample(s + paint.offset.x(), t + paint.offset.y(), footprint, value.data());
      for (int c = 0; c < 3; ++c) {
        colour[c] = texture.channels() == 3 ? value[c] : colour[c] + paint.swing[c] * (value[0] - 0.5f);
      }
    }
    const float light = paint.glows ? 1.0f : light_at(face.light, s, t, k.width, k.height);
    for (int c = 0; c < 3; ++c) out[c] = colour[c] * light;
  }

  void shade_edge(const RenderedFrame& frame, int x, int y, float* out) const noexcept {
    Visibility::Candidates ids{};
    const int count = visibility_.candidates(frame, x, y, ids);
    const float u = static_cast<float>(x), v = static_cast<float>(y);
    std::array<int, Visibility::kMaxCandidates> hits{};
    std::array<Vec2<float>, Visibility::kMaxCandidates> mean;
    mean.fill(Vec2<float>::Zero());
    int total = 0;
    for (const Vec2<float>& offset : offsets_) {
      const int seen = nearest(ids, count, u + offset.x(), v + offset.y());
      if (seen < 0) continue;
      ++hits[seen];
      ++total;
      mean[seen] += offset;
    }
    out[0] = out[1] = out[2] = 0.0f;
    for (int i = 0; i < count; ++i) {
      if (hits[i] == 0) continue;
      std::array<float, 3> colour{};
      mean[i] /= static_cast<float>(hits[i]);
      shade(ids[i], u + mean[i].x(), v + mean[i].y(), colour.data());
      const float weight = static_cast<float>(hits[i]) / static_cast<float>(total);
      for (int c = 0; c < 3; ++c) out[c] += weight * colour[c];
    }
  }

  // The position in `ids` of the nearest face at (u, v), -1 when there is none.
  [[nodiscard]] int nearest(const Visibility::Candidates& ids, int count, float u, float v) const noexcept {
    int best = -1;
    float best_inverse = 0.0f;
    for (int i = 0; i < count; ++i) {
      const Shading& k = shading_[ids[i]];
      const float w = k.w.x() * u + k.w.y() * v + k.w.z();
      if (w <= best_inverse) continue;
      const float s = k.s.x() * u + k.s.y() * v + k.s.z(), t = k.t.x() * u + k.t.y() * v + k.t.z();
      const float slack = static_cast<float>(FaceView::kOverlap) * w;
      if (s < -slack || t < -slack || s > k.width * w + slack || t > k.height * w + slack) continue;
      best = i;
      best_inverse = w;
    }
    return best;
  }

  const Scene& scene_;
  std::array<Vec2<float>, kSamples> offsets_;
  Visibility visibility_;
  std::vector<Shading> shading_;
};

}  // namespace sslam::synth
