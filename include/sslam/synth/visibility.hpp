// SPDX-License-Identifier: BSD-3-Clause
// Which face each pixel's centre shows, and which faces have an edge that crosses near a pixel.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sslam/synth/cells_in_view.hpp"
#include "sslam/synth/face_view.hpp"
#include "sslam/synth/rendered_frame.hpp"

namespace sslam::synth {

// Pixels from left to right and top to bottom, both inclusive.
struct PixelBlock {
  int left, top, right, bottom;
};

class Visibility {
 public:
  static constexpr int kMaxCandidates = 16;
  using Candidates = std::array<std::int32_t, kMaxCandidates>;

  // Fills surface, inverse_depth, normals and face of the frame.
  void find(const Scene& scene, const View& view, RenderedFrame& frame) {
    frame.resize(view.width, view.height);
    faces_.clear();
    if (scene.cells.empty()) {
      for (std::size_t i = 0; i < scene.faces.size(); ++i) take(scene, static_cast<int>(i), view, frame);
    } else {
      for (const std::int32_t cell : cells_.find(scene, view)) {
        for (const std::int32_t i : scene.cells[static_cast<std::size_t>(cell)].faces)
          take(scene, i, view, frame);
      }
    }
    chain_.assign(frame.surface.size(), kInterior);
    links_.clear();
    mark_changes(frame);
    for (std::size_t i = 0; i < faces_.size(); ++i) outline(scene, view, static_cast<std::int32_t>(i), frame);
  }

  // That are turned to the camera, within the image and in a room that is in view: what a frame costs.
  [[nodiscard]] const std::vector<FaceView>& faces() const noexcept { return faces_; }
  // True where one of the pixels may show more than one face.
  [[nodiscard]] bool mixed(const RenderedFrame& frame, const PixelBlock& block) const noexcept {
    for (int v = block.top; v <= block.bottom; ++v) {
      for (int u = block.left; u <= block.right; ++u) {
        if (chain_[static_cast<std::size_t>(v) * frame.width + u] != kInterior) return true;
      }
    }
    return false;
  }

  // The faces that the block of pixels may show; returns how many.
  [[nodiscard]] int candidates(const RenderedFrame& frame, const PixelBlock& block,
                               Candidates& out) const noexcept {
    int count = 0;
    const auto add = [&](std::int32_t id) {
      if (id < 0 || count == kMaxCandidates) return;
      if (std::find(out.begin(), out.begin() + count, id) == out.begin() + count) out[count++] = id;
    };
    for (int v = std::max(0, block.top - 1); v <= std::min(frame.height - 1, block.bottom + 1); ++v) {
      for (int u = std::max(0, block.left - 1); u <= std::min(frame.width - 1, block.right + 1); ++u) {
        add(frame.surface[static_cast<std::size_t>(v) * frame.width + u]);
      }
    }
    for (int v = block.top; v <= block.bottom; ++v) {
      for (int u = block.left; u <= block.right; ++u) {
        const std::size_t pixel = static_cast<std::size_t>(v) * frame.width + u;
        for (std::int32_t i = chain_[pixel]; i >= 0; i = links_[i].next) add(links_[i].face);
      }
    }
    return count;
  }

 private:
  struct Link {
    std::int32_t face, next;
  };
  static constexpr std::int32_t kInterior = -2, kEnd = -1;

  void take(const Scene& scene, int index, const View& view, RenderedFrame& frame) {
    FaceView face;
    if (!view_face(scene.faces[static_cast<std::size_t>(index)], index, view, face)) return;
    draw(face, static_cast<std::int32_t>(faces_.size()), frame);
    faces_.push_back(face);
    frame.normals.push_back(face.normal.cast<float>());
    frame.face.push_back(face.face);
  }

  static void draw(const FaceView& face, std::int32_t id, RenderedFrame& frame) {
    for (int y = face.first_row; y <= face.last_row; ++y) {
      const RowSpan span = row_span(face, y, frame.width);
      if (!(span.low <= span.high)) continue;
      const int first = static_cast<int>(std::ceil(span.low));
      const int count = static_cast<int>(std::floor(span.high)) - first + 1;
      const float start =
          static_cast<float>(face.inverse.x() * first + face.inverse.y() * y + face.inverse.z());
      const float slope = static_cast<float>(face.inverse.x());
      const std::size_t offset = static_cast<std::size_t>(y) * frame.width + first;
      float* nearest = &frame.inverse_depth[offset];
      std::int32_t* shown = &frame.surface[offset];
      for (int i = 0; i < count; ++i) {
        const float inverse = start + slope * static_cast<float>(i);
        const bool nearer = inverse > nearest[i];
        shown[i] = nearer ? id : shown[i];
        nearest[i] = nearer ? inverse : nearest[i];
      }
    }
  }

  void mark(std::size_t pixel) noexcept {
    if (chain_[pixel] == kInterior) chain_[pixel] = kEnd;
  }

  // Where neighbouring centres show different faces; this also finds where two faces cut through each other.
  void mark_changes(const RenderedFrame& frame) noexcept {
    const std::size_t width = static_cast<std::size_t>(frame.width);
    const std::int32_t* shown = frame.surface.data();
    for (std::size_t i = 0; i + width < frame.surface.size(); ++i) {
      const bool across = shown[i] != shown[i + 1] && (i + 1) % width != 0;
      const bool down = shown[i] != shown[i + width];
      if (!across && !down) continue;
      mark(i);
      if (across) mark(i + 1);
      if (down) mark(i + width);
    }
  }

  void outline(const Scene& scene, const View& view, std::int32_t id, const RenderedFrame& frame) {
    const Face& face = scene.faces[faces_[id].face];
    const std::array<Vec3<double>, 4> corner{view.cam_from_world * face.at(0.0, 0.0),
                                             view.cam_from_world * face.at(face.width, 0.0),
                                             view.cam_from_world * face.at(face.width, face.height),
                                             view.cam_from_world * face.at(0.0, face.height)};
    for (int i = 0; i < 4; ++i) edge(view, id, corner[i], corner[(i + 1) % 4], frame);
  }

  // Walks one edge pixel by pixel and notes the face wherever the edge is not hidden: a face too thin to
  // cover a pixel's centre is found here.
  void edge(const View& view, std::int32_t id, Vec3<double> a, Vec3<double> b, const RenderedFrame& frame) {
    constexpr double kNear = 0.02;
    if (a.z() < kNear && b.z() < kNear) return;
    if (a.z() < kNear) a += (kNear - a.z()) / (b.z() - a.z()) * (b - a);
    if (b.z() < kNear) b += (kNear - b.z()) / (a.z() - b.z()) * (a - b);
    Vec2<double> p = view.pinhole.project(a), q = view.pinhole.project(b);
    const Vec2<double> run = (q - p).cwiseAbs();
    const int major = run.x() >= run.y() ? 0 : 1, minor = 1 - major;
    if (p[major] > q[major]) std::swap(p, q);
    const double slope = run[major] > 1e-9 ? (q[minor] - p[minor]) / (q[major] - p[major]) : 0.0;
    const int limit[2] = {frame.width - 1, frame.height - 1};
    const int first = static_cast<int>(std::ceil(std::clamp(p[major] - 1.0, 0.0, limit[major] + 1.0)));
    const int last = static_cast<int>(std::floor(std::clamp(q[major] + 1.0, -1.0, limit[major] * 1.0)));
    const double reach = 1.0 + 0.5 * std::abs(slope);
    for (int i = first; i <= last; ++i) {
      const double across = p[minor] + slope * (std::clamp(i * 1.0, p[major], q[major]) - p[major]);
      if (across < -2.0 || across > limit[minor] + 2.0) continue;
      const int low = std::max(0, static_cast<int>(std::ceil(across - reach)));
      const int high = std::min(limit[minor], static_cast<int>(std::floor(across + reach)));
      const Vec3<double> at = major == 0 ? Vec3<double>(i, across, 1.0) : Vec3<double>(across, i, 1.0);
      note(id, faces_[id].inverse.dot(at), major == 0, i, low, high, frame);
    }
  }

  // Links the face to the pixels low..high across its edge, unless all of them show something clearly nearer.
  void note(std::int32_t id, double inverse, bool horizontal, int along, int low, int high,
            const RenderedFrame& frame) {
    const auto pixel = [&](int across) {
      return horizontal ? static_cast<std::size_t>(across) * frame.width + along
                        : static_cast<std::size_t>(along) * frame.width + across;
    };
    constexpr double kSlack = 1.01;
    bool hidden = true;
    for (int k = low; k <= high; ++k) hidden = hidden && frame.inverse_depth[pixel(k)] > kSlack * inverse;
    if (hidden) return;
    for (int k = low; k <= high; ++k) {
      const std::size_t i = pixel(k);
      links_.push_back({id, std::max(chain_[i], kEnd)});
      chain_[i] = static_cast<std::int32_t>(links_.size()) - 1;
    }
  }

  CellsInView cells_;
  std::vector<FaceView> faces_;
  std::vector<std::int32_t> chain_;  // per pixel: first link, kEnd, or kInterior
  std::vector<Link> links_;
};

}  // namespace sslam::synth
