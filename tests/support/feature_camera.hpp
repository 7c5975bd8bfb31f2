// SPDX-License-Identifier: BSD-3-Clause
// A camera that sees a rendered house as features alone: what the front end would hand over for an image,
// projected from the house's own geometry with noise, hidden by what stands before it. The same options give
// the same features, frame by frame, in whatever order they are asked for.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "sslam/map/frame.hpp"
#include "sslam/synth/visibility.hpp"
#include "support/random_draws.hpp"
#include "support/surface_marks.hpp"

namespace sslam::testing {

struct FeatureCameraOptions {
  int width = 640, height = 480;
  double focal = 480;         // pixels
  double pitch = 0.12;        // metres from point to point on a textured surface
  std::size_t points = 1200;  // at most, the strongest
  double point_sigma = 0.5;   // pixels at full resolution
  double line_sigma = 0.4;    // of an end across the line, pixels
  double missed = 0.1;        // share of what is in view that is not found
  double clutter = 0.04;      // share of points that belong to nothing
  std::uint64_t seed = 1;
};

class FeatureCamera {
 public:
  // The scene must outlive the camera.
  FeatureCamera(const synth::Scene& scene, const FeatureCameraOptions& options)
      : scene_(scene),
        options_(options),
        marks_(scene, options.pitch, options.seed),
        drawn_(marks_.edges.size(), -1) {}

  [[nodiscard]] const SurfaceMarks& marks() const { return marks_; }

  // Fills the frame again, whose buffers stay.
  void take(const SE3<double>& cam_from_world, std::int64_t index, double stamp, Frame<double>& frame) {
    Random random(options_.seed * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(index));
    begin(index, stamp, frame);
    look(cam_from_world);
    seen_.clear();
    for (const synth::FaceView& face : visibility_.faces()) {
      const auto [first, last] = marks_.points_of(static_cast<std::size_t>(face.face));
      for (std::size_t i = first; i < last; ++i) see_point(cam_from_world, face.face, i);
      for (const std::int32_t edge : marks_.edges_of(static_cast<std::size_t>(face.face)))
        see_edge(cam_from_world, edge, random, frame);
    }
    take_points(cam_from_world, random, frame);
  }

 private:
  static constexpr int kCoarse = 4;     // pixels of the image for one of the depth test, either way
  static constexpr double kNear = 0.1;  // metres
  static constexpr double kRatio = 1.2;
  static constexpr int kLevels = 8;

  struct Seen {
    std::size_t point;
    Vec2<double> pixel;
    double scale;
    float slant;  // cosine between the ray and the surface's normal
  };

  void begin(std::int64_t index, double stamp, Frame<double>& frame) {
    ++taken_;
    frame.index = index;
    frame.stamp = stamp;
    frame.pinhole = {options_.focal, options_.focal, 0.5 * (options_.width - 1), 0.5 * (options_.height - 1)};
    frame.width = options_.width;
    frame.height = options_.height;
    frame.points.clear();
    frame.lines.clear();
  }

  void look(const SE3<double>& cam_from_world) {
    const int width = options_.width / kCoarse, height = options_.height / kCoarse;
    const double focal = options_.focal / kCoarse;
    visibility_.find(scene_,
                     {{focal, focal, 0.5 * (width - 1), 0.5 * (height - 1)}, width, height, cam_from_world},
                     depth_);
    pinhole_ = {options_.focal, options_.focal, 0.5 * (options_.width - 1), 0.5 * (options_.height - 1)};
  }

  // Whether one of the faces is shown at the pixel or next to it.
  [[nodiscard]] bool shows(const Vec2<double>& pixel, std::int32_t a, std::int32_t b) const {
    const int x = static_cast<int>(pixel.x() / kCoarse), y = static_cast<int>(pixel.y() / kCoarse);
    for (int v = std::max(0, y - 1); v <= std::min(depth_.height - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(depth_.width - 1, x + 1); ++u) {
        const std::int32_t shown = depth_.surface[static_cast<std::size_t>(v * depth_.width + u)];
        if (shown < 0) continue;
        const std::int32_t face = depth_.face[static_cast<std::size_t>(shown)];
        if (face == a || face == b) return true;
      }
    return false;
  }

  [[nodiscard]] bool inside(const Vec2<double>& p) const {
    return p.x() > 1 && p.y() > 1 && p.x() < options_.width - 2 && p.y() < options_.height - 2;
  }

  void see_point(const SE3<double>& cam_from_world, std::int32_t face, std::size_t i) {
    const SurfacePoint& point = marks_.points[i];
    const Vec3<double> at = cam_from_world * point.position;
    if (at.z() < kNear) return;
    const double scale = point.distance / at.z() * (options_.focal / 480);
    if (scale < 0.9 || scale > std::pow(kRatio, kLevels - 0.5)) return;
    const Vec2<double> pixel = pinhole_.project(at);
    if (!inside(pixel) || !shows(pixel, face, face)) return;
    const Vec3<double> normal =
        cam_from_world.rotation * scene_.faces[static_cast<std::size_t>(face)].normal();
    const double slant = std::abs(normal.dot(at)) / at.norm();
    if (slant > 0.15) seen_.push_back({i, pixel, scale, static_cast<float>(slant)});
  }

  void take_points(const SE3<double>& cam_from_world, Random& random, Frame<double>& frame) {
    if (seen_.size() > options_.points) {
      std::nth_element(seen_.begin(), seen_.begin() + static_cast<std::ptrdiff_t>(options_.points),
                       seen_.end(), [&](const Seen& a, const Seen& b) {
                         return std::pair(-marks_.points[a.point].strength, a.point) <
                                std::pair(-marks_.points[b.point].strength, b.point);
                       });
      seen_.resize(options_.points);
    }
    std::sort(seen_.begin(), seen_.end(), [](const Seen& a, const Seen& b) { return a.point < b.point; });
    for (const Seen& seen : seen_) {
      if (random.uniform(0.0, 1.0) < options_.missed) continue;
      const SurfacePoint& point = marks_.points[seen.point];
      PointFeature<double> f = point_of_scale(seen.scale);
      f.pixel = seen.pixel + f.sigma * gaussian_vector<2>(random);
      const Vec3<double> at = cam_from_world * point.position;
      const Vec2<double> turned =
          pinhole_.project(at + 0.01 * (cam_from_world.rotation * point.along)) - seen.pixel;
      f.angle = std::atan2(turned.y(), turned.x());
      f.descriptor = noisy(point.descriptor, 8 + static_cast<int>(40 * (1 - seen.slant)), random);
      frame.points.push_back(f);
    }
    for (auto rest = static_cast<int>(options_.clutter * static_cast<double>(seen_.size())); rest > 0;
         --rest) {
      PointFeature<double> f = point_of_scale(random.uniform(1.0, 3.0));
      f.pixel.x() = random.uniform(1.0, options_.width - 2.0);
      f.pixel.y() = random.uniform(1.0, options_.height - 2.0);
      f.descriptor = random_descriptor(random);
      frame.points.push_back(f);
    }
  }

  [[nodiscard]] PointFeature<double> point_of_scale(double scale) const {
    PointFeature<double> f;
    f.octave =
        static_cast<std::uint8_t>(std::clamp(std::log(scale) / std::log(kRatio) + 0.5, 0.0, kLevels - 1.0));
    f.sigma = options_.point_sigma * std::pow(kRatio, f.octave);
    return f;
  }

  // The longest stretch that is not hidden; its ends lie within by a tenth at most, as a detector's do.
  void see_edge(const SE3<double>& cam_from_world, std::int32_t id, Random& random, Frame<double>& frame) {
    if (std::exchange(drawn_[static_cast<std::size_t>(id)], taken_) == taken_) return;
    const SurfaceEdge& edge = marks_.edges[static_cast<std::size_t>(id)];
    Vec3<double> a = cam_from_world * edge.start, b = cam_from_world * edge.end;
    if (a.z() < kNear && b.z() < kNear) return;
    if (a.z() < kNear) a += (kNear - a.z()) / (b.z() - a.z()) * (b - a);
    if (b.z() < kNear) b += (kNear - b.z()) / (a.z() - b.z()) * (a - b);
    const Vec2<double> p = pinhole_.project(a), q = pinhole_.project(b);
    const int steps = std::clamp(static_cast<int>((q - p).norm() / 8), 2, 120);
    int best = 0, begin = 0, run = 0;
    for (int i = 0; i <= steps; ++i) {
      const Vec2<double> at = p + (q - p) * i / steps;
      run = inside(at) && shows(at, edge.face[0], edge.face[1]) ? run + 1 : 0;
      if (run > best) best = run, begin = i - run + 1;
    }
    const double length = (q - p).norm() * std::max(0, best - 1) / steps;
    if (length < 25 || random.uniform(0.0, 1.0) < options_.missed) return;
    const Vec2<double> along = (q - p).normalized(), across(-along.y(), along.x());
    const Vec2<double> slides = std::min(5.0, 0.1 * length) * uniform_vector<double, 2>(random, 0.0, 1.0);
    const Vec2<double> noise = options_.line_sigma * gaussian_vector<2>(random);
    const Vec2<double> start = p + (q - p) * begin / steps;
    LineFeature<double> f;
    f.sigma = options_.line_sigma;
    f.segment.start = start + slides[0] * along + noise[0] * across;
    f.segment.end = start + (length - slides[1]) * along + noise[1] * across;
    f.descriptor = noisy(edge.descriptor, 12, random);
    frame.lines.push_back(f);
  }

  // Some bits flip from view to view.
  [[nodiscard]] static Descriptor noisy(Descriptor d, int bits, Random& random) {
    for (int i = 0; i < bits; ++i) {
      const std::uint64_t draw = random.next();
      d.words[draw & 3U] ^= 1ULL << (draw >> 2 & 63U);
    }
    return d;
  }

  const synth::Scene& scene_;
  FeatureCameraOptions options_;
  SurfaceMarks marks_;
  synth::Visibility visibility_;
  synth::RenderedFrame depth_;
  Pinhole<double> pinhole_;
  std::vector<Seen> seen_;
  std::int64_t taken_ = 0;           // frames
  std::vector<std::int64_t> drawn_;  // by edge: the frame that it was looked at for last
};

}  // namespace sslam::testing
