// SPDX-License-Identifier: BSD-3-Clause
// Joins segments that lie on one line, one behind the other or on top of each other, into one segment.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "sslam/geometry/line2.hpp"

namespace sslam {

struct SegmentMergeOptions {
  double max_angle_deg = 2.5;  // between the directions
  double max_offset = 1.5;     // of the shorter segment's endpoints from the longer one's line, pixels
  double max_gap = 12;         // between the near endpoints, pixels ...
  double max_gap_ratio = 0.3;  // ... and over the length of the longer one
};

// Directions count: a bright-to-dark edge never joins a dark-to-bright one.
[[nodiscard]] inline bool mergeable(const Segment2<double>& longer, const Segment2<double>& shorter,
                                    const SegmentMergeOptions& options) noexcept {
  const double length = longer.length();
  const Vec2<double> d = (longer.end - longer.start) / length;
  const Vec2<double> e = shorter.end - shorter.start;
  const auto cross = [&d](const Vec2<double>& v) { return d.x() * v.y() - d.y() * v.x(); };
  if (e.dot(d) <= 0 || std::abs(cross(e)) > std::tan(radians(options.max_angle_deg)) * e.dot(d)) return false;
  const Vec2<double> s0 = shorter.start - longer.start, s1 = shorter.end - longer.start;
  if (std::max(std::abs(cross(s0)), std::abs(cross(s1))) > options.max_offset) return false;
  const double gap = std::max(s0.dot(d) - length, -s1.dot(d));
  return gap <= std::min(options.max_gap, options.max_gap_ratio * length);
}

// The line through the four endpoints, weighted by segment length, over the extent of both.
[[nodiscard]] inline Segment2<double> joined(const Segment2<double>& a, const Segment2<double>& b) noexcept {
  const double wa = a.length(), wb = b.length();
  const Vec2<double> centre = (wa * a.midpoint() + wb * b.midpoint()) / (wa + wb);
  // Scatter of two uniform rods about their common centre.
  Mat2<double> scatter = Mat2<double>::Zero();
  for (const auto* s : {&a, &b}) {
    const Vec2<double> along = s->end - s->start, off = s->midpoint() - centre;
    scatter += s->length() * (along * along.transpose() / 12 + off * off.transpose());
  }
  const double angle = 0.5 * std::atan2(2 * scatter(0, 1), scatter(0, 0) - scatter(1, 1));
  Vec2<double> d(std::cos(angle), std::sin(angle));
  if (d.dot(a.end - a.start) < 0) d = -d;
  double low = 0, high = 0;
  for (const auto* p : {&a.start, &a.end, &b.start, &b.end}) {
    low = std::min(low, d.dot(*p - centre));
    high = std::max(high, d.dot(*p - centre));
  }
  return {centre + low * d, centre + high * d};
}

// Merges in place, longest segments first, until nothing fits any more; the order of the result is by length.
inline void merge_segments(std::vector<Segment2<double>>& segments, const SegmentMergeOptions& options) {
  const auto longer = [](const auto& a, const auto& b) { return a.length() > b.length(); };
  for (bool changed = true; changed;) {
    changed = false;
    std::stable_sort(segments.begin(), segments.end(), longer);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      std::size_t into = 0;
      while (into < kept && !mergeable(segments[into], segments[i], options)) ++into;
      if (into < kept) {
        segments[into] = joined(segments[into], segments[i]);
        changed = true;
      } else {
        segments[kept++] = segments[i];
      }
    }
    segments.resize(kept);
  }
}

}  // namespace sslam
