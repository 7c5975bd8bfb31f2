// SPDX-License-Identifier: BSD-3-Clause
// Fits a segment to the steepest brightness change across it, and says how exactly.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sslam/core/inline_vector.hpp"
#include "sslam/core/parameter.hpp"
#include "sslam/geometry/line2.hpp"
#include "sslam/image/image_view.hpp"

namespace sslam {

struct SegmentRefineOptions {
  double reach = 3;          // searched on either side, pixels
  double min_support = 0.5;  // share of the samples that must show the edge
  double floor_sigma =
      0.2;  // of an endpoint across the segment, pixels: what the fit's own scatter does not show

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("reach", self.reach, Unit::kPixels, 1, 6, "searched on either side of a segment");
    visit("min_support", self.min_support, Unit::kShare, 0, 1, "of the samples that must show the edge");
    visit("floor_sigma", self.floor_sigma, Unit::kPixels, 0.001, 100,
          "of an end across the segment: the least standard deviation");
  }
};
static_assert(Described<SegmentRefineOptions>);

struct RefinedSegment {
  Segment2<double> segment;
  double sigma = 1;    // of an endpoint across the segment, pixels
  bool found = false;  // false: too little of the segment shows an edge
};

class SegmentRefiner {
 public:
  // The edge must rise towards the left hand of start -> end (x right, y down), as
  // the detector's segments do.
  [[nodiscard]] static RefinedSegment refine(ImageView<std::uint8_t> image, const Segment2<double>& rough,
                                             const SegmentRefineOptions& options) noexcept {
    RefinedSegment refined{rough, 1, false};
    if (!fit(sample(image, rough, options.reach), options, refined)) return {rough, 1, false};
    refined.found = true;
    return refined;
  }

 private:
  static constexpr int kMaxSamples = 64;
  static constexpr int kMaxReach = 6;
  struct Edge {
    double along, across, strength;  // pixels from the midpoint; grey levels a pixel
  };
  struct Samples {
    InlineVector<Edge, kMaxSamples> edges;
    int taken = 0;
    double spacing = 1;
  };

  [[nodiscard]] static float at(ImageView<std::uint8_t> image, double x, double y) noexcept {
    const int x0 = std::clamp(static_cast<int>(x), 0, image.width() - 2);
    const int y0 = std::clamp(static_cast<int>(y), 0, image.height() - 2);
    const float fx = static_cast<float>(x) - static_cast<float>(x0),
                fy = static_cast<float>(y) - static_cast<float>(y0);
    const std::uint8_t* a = image.row(y0) + x0;
    const std::uint8_t* b = image.row(y0 + 1) + x0;
    const float top = static_cast<float>(a[0]) + fx * static_cast<float>(a[1] - a[0]);
    const float bottom = static_cast<float>(b[0]) + fx * static_cast<float>(b[1] - b[0]);
    return top + fy * (bottom - top);
  }

  // The place of the steepest rise along the normal at evenly spaced places of the segment.
  [[nodiscard]] static Samples sample(ImageView<std::uint8_t> image, const Segment2<double>& s,
                                      double max_offset) noexcept {
    Samples samples;
    const double length = s.length();
    const Vec2<double> d = (s.end - s.start) / length, normal(d.y(), -d.x());
    const int n = std::clamp(static_cast<int>(length), 8, kMaxSamples);
    const int reach = std::clamp(static_cast<int>(std::lround(max_offset)), 1, kMaxReach);
    samples.taken = n;
    samples.spacing = length / n;
    for (int i = 0; i < n; ++i) {
      const double along = (i + 0.5) * samples.spacing - length / 2;
      const Vec2<double> p = s.midpoint() + along * d;
      std::array<float, 2 * kMaxReach + 5> profile{};
      const int size = 2 * reach + 5;  // two more on either side for the derivative and its neighbours
      for (int k = 0; k < size; ++k) {
        const double offset = k - reach - 2;
        profile[static_cast<std::size_t>(k)] =
            at(image, p.x() + offset * normal.x(), p.y() + offset * normal.y());
      }
      add_edge(profile, reach, along, samples);
    }
    return samples;
  }

  static void add_edge(const std::array<float, 2 * kMaxReach + 5>& profile, int reach, double along,
                       Samples& samples) noexcept {
    const auto slope = [&](int k) {  // at offset k - reach
      const auto i = static_cast<std::size_t>(k + 2);
      return (profile[i + 1] - profile[i - 1]) / 2;
    };
    int best = -1;
    float steepest = 0.5F;  // grey levels a pixel: below, rounding alone decides
    for (int k = 0; k <= 2 * reach; ++k) {
      const float value = slope(k);
      if (value > steepest && value >= slope(k - 1) && value >= slope(k + 1)) {
        steepest = value;
        best = k;
      }
    }
    if (best < 0) return;
    const float left = slope(best - 1), right = slope(best + 1);
    const float curvature = left - 2 * steepest + right;
    const float shift = curvature < 0 ? 0.5F * (left - right) / curvature : 0.0F;
    (void)samples.edges.push_back({along, best - reach + static_cast<double>(shift), steepest});
  }

  // Robust straight line `across = a + b along`, and the extent of the samples on it.
  [[nodiscard]] static bool fit(const Samples& samples, const SegmentRefineOptions& options,
                                RefinedSegment& refined) noexcept {
    const auto needed = static_cast<std::size_t>(std::max(4.0, options.min_support * samples.taken));
    if (samples.edges.size() < needed) return false;
    double a = 0, b = 0, scale = options.reach;
    for (int round = 0; round < 4; ++round) {
      double w0 = 0, w1 = 0, w2 = 0, y0 = 0, y1 = 0, loss = 0;
      for (const Edge& e : samples.edges) {
        const double r = (e.across - a - b * e.along) / scale;
        const double w = 1 / ((1 + r * r) * (1 + r * r));  // Geman-McClure
        w0 += w;
        w1 += w * e.along;
        w2 += w * e.along * e.along;
        y0 += w * e.across;
        y1 += w * e.along * e.across;
        loss += w * r * r * scale * scale;
      }
      const double det = w0 * w2 - w1 * w1;
      if (!(det > 1e-9)) return false;
      a = (w2 * y0 - w1 * y1) / det;
      b = (w0 * y1 - w1 * y0) / det;
      scale = std::clamp(2.5 * std::sqrt(loss / w0), 0.4, scale);
    }
    return apply(samples, a, b, scale, needed, options, refined);
  }

  [[nodiscard]] static bool apply(const Samples& samples, double a, double b, double scale,
                                  std::size_t needed, const SegmentRefineOptions& options,
                                  RefinedSegment& refined) noexcept {
    double low = 1e30, high = -1e30, sum = 0;
    std::size_t inliers = 0;
    for (const Edge& e : samples.edges) {
      const double r = e.across - a - b * e.along;
      if (std::abs(r) > scale) continue;
      low = std::min(low, e.along);
      high = std::max(high, e.along);
      sum += r * r;
      ++inliers;
    }
    if (inliers < needed) return false;
    low -= samples.spacing / 2;
    high += samples.spacing / 2;
    const Vec2<double> d = refined.segment.direction(), normal(d.y(), -d.x()),
                       centre = refined.segment.midpoint();
    refined.segment = {centre + low * d + (a + b * low) * normal,
                       centre + high * d + (a + b * high) * normal};
    // A fitted line is twice as uncertain at its ends as at its middle.
    const double n = static_cast<double>(inliers);
    refined.sigma = std::hypot(options.floor_sigma, 2 * std::sqrt(sum / std::max(1.0, n - 2) / n));
    return true;
  }
};

}  // namespace sslam
