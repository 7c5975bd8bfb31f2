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
#include "sslam/synth/lens_grid.hpp"
#include "sslam/synth/noise.hpp"
#include "sslam/synth/rendered_frame.hpp"
#include "sslam/synth/scene.hpp"
#include "sslam/synth/visibility.hpp"

namespace sslam::synth {

class Renderer {
 public:
  // The scene must outlive the renderer; its faces must have light maps (bake_lighting, light_late).
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
    find(view, frame);
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * frame.width + x;
        paint(frame, {Vec2<float>(static_cast<float>(x), static_cast<float>(y))}, &frame.rgb[3 * i]);
      }
    }
  }

  // Rows top to bottom (exclusive) of a frame of the image's size, which keeps its other rows. The view's
  // pinhole is that of the image; it is the lens that says where its pixels lie. Normals and faces are added
  // to the frame's.
  void render_rows(const View& view, const LensGrid& lens, int top, int bottom, RenderedFrame& frame) {
    const LensGrid::Part part = lens.part(view, top, bottom);
    find(part.view, part_);
    const std::int32_t first = static_cast<std::int32_t>(frame.normals.size());
    frame.normals.insert(frame.normals.end(), part_.normals.begin(), part_.normals.end());
    frame.face.insert(frame.face.end(), part_.face.begin(), part_.face.end());
    for (int y = top; y < bottom; ++y) {
      for (int x = 0; x < view.width; ++x) {
        const LensPoint point = lens.at(x, y, part);
        const std::size_t i = static_cast<std::size_t>(y) * view.width + x;
        paint(part_, point, &frame.rgb[3 * i]);
        const int seen = seen_at(part_, point.place);
        frame.surface[i] = seen < 0 ? -1 : first + seen;
        frame.inverse_depth[i] = seen < 0 ? 0.0f : shading_[seen].inverse_depth(point.place);
      }
    }
  }

 private:
  // The three forms of a FaceView in single precision.
  struct Shading {
    Shading(const FaceView& view, const LightMap& light_map)
        : light(&light_map),
          w(view.inverse.cast<float>()),
          s(view.s_form.cast<float>()),
          t(view.t_form.cast<float>()),
          width(static_cast<float>(view.width)),
          height(static_cast<float>(view.height)),
          face(view.face) {}
    [[nodiscard]] float inverse_depth(const Vec2<float>& at) const noexcept {
      return w.x() * at.x() + w.y() * at.y() + w.z();
    }
    const LightMap* light;
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

  void find(const View& view, RenderedFrame& frame) {
    visibility_.find(scene_, view, frame);
    shading_.clear();
    for (const FaceView& face : visibility_.faces())
      shading_.emplace_back(face, scene_.light(static_cast<std::size_t>(face.face)));
  }

  // The pixels around a point; one where it is the centre of a pixel.
  static PixelBlock block_around(const Vec2<float>& at) noexcept {
    return {static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())),
            static_cast<int>(std::ceil(at.x())), static_cast<int>(std::ceil(at.y()))};
  }

  // The face in the first of the pixels; all of them show the same where none is mixed.
  static std::int32_t surface_in(const RenderedFrame& frame, const PixelBlock& block) noexcept {
    return frame.surface[static_cast<std::size_t>(block.top) * frame.width + block.left];
  }

  void paint(const RenderedFrame& frame, const LensPoint& point, float* out) const {
    const PixelBlock block = block_around(point.place);
    if (visibility_.mixed(frame, block)) {
      shade_edge(frame, block, point, out);
    } else if (const std::int32_t id = surface_in(frame, block); id >= 0) {
      shade(id, point.place.x(), point.place.y(), point.spread, out);
    } else {
      out[0] = out[1] = out[2] = 0.0f;
    }
  }

  // The face that a point shows, -1 for none.
  [[nodiscard]] int seen_at(const RenderedFrame& frame, const Vec2<float>& at) const noexcept {
    const PixelBlock block = block_around(at);
    if (!visibility_.mixed(frame, block)) return surface_in(frame, block);
    Visibility::Candidates ids{};
    const int seen = nearest(ids, visibility_.candidates(frame, block, ids), at.x(), at.y());
    return seen < 0 ? -1 : ids[seen];
  }

  void shade(int id, float u, float v, const Mat2<float>& spread, float* out) const {
    const Shading& k = shading_[id];
    const float z = 1.0f / (k.w.x() * u + k.w.y() * v + k.w.z());
    const float s = std::clamp((k.s.x() * u + k.s.y() * v + k.s.z()) * z, 0.0f, k.width);
    const float t = std::clamp((k.t.x() * u + k.t.y() * v + k.t.z()) * z, 0.0f, k.height);
    const Face& face = scene_.faces[k.face];
    const Paint& paint = face.paint;
    std::array<float, 3> colour{paint.colour.x(), paint.colour.y(), paint.colour.z()};
    if (paint.texture >= 0) {
      const Texture& texture = scene_.textures[paint.texture];
      const Vec2<float> across((k.s.x() - s * k.w.x()) * z, (k.t.x() - t * k.w.x()) * z);
      const Vec2<float> down((k.s.y() - s * k.w.y()) * z, (k.t.y() - t * k.w.y()) * z);
      const Footprint footprint{spread(0, 0) * across + spread(1, 0) * down,
                                spread(0, 1) * across + spread(1, 1) * down};
      std::array<float, 3> value{};
      texture.sample(s + paint.offset.x(), t + paint.offset.y(), footprint, value.data());
      for (int c = 0; c < 3; ++c) {
        colour[c] = texture.channels() == 3 ? value[c] : colour[c] + paint.swing[c] * (value[0] - 0.5f);
      }
    }
    const float light = paint.glows ? 1.0f : light_at(*k.light, s, t, k.width, k.height);
    for (int c = 0; c < 3; ++c) out[c] = colour[c] * light;
  }

  void shade_edge(const RenderedFrame& frame, const PixelBlock& block, const LensPoint& point,
                  float* out) const {
    Visibility::Candidates ids{};
    const int count = visibility_.candidates(frame, block, ids);
    const float u = point.place.x(), v = point.place.y();
    std::array<int, Visibility::kMaxCandidates> hits{};
    std::array<Vec2<float>, Visibility::kMaxCandidates> mean;
    mean.fill(Vec2<float>::Zero());
    int total = 0;
    for (const Vec2<float>& step : offsets_) {
      const Vec2<float> offset = point.spread * step;
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
      shade(ids[i], u + mean[i].x(), v + mean[i].y(), point.spread, colour.data());
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
  RenderedFrame part_;  // of the rows that are rendered
};

}  // namespace sslam::synth
