// SPDX-License-Identifier: BSD-3-Clause
// Joins segments that lie on one line, one behind the other or on top of each other, into one segment.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/geometry/line2.hpp"

namespace sslam {

struct SegmentMergeOptions {
  double max_angle = radians(2.5);  // between the directions
  double max_offset = 1.5;          // of the shorter segment's endpoints from the longer one's line, pixels
  double max_gap = 12;              // between the near endpoints, pixels ...
  double max_gap_ratio = 0.3;       // ... and over the length of the longer one

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("max_angle", self.max_angle, Unit::kDegrees, 0, 80, "between the directions of two pieces");
    visit("max_offset", self.max_offset, Unit::kPixels, 0, kUnbounded,
          "of the shorter piece from the longer one's line");
    visit("max_gap", self.max_gap, Unit::kPixels, 0, kUnbounded, "between the near ends of two pieces");
    visit("max_gap_ratio", self.max_gap_ratio, Unit::kNumber, 0, 100,
          "of that gap over the length of the longer piece");
  }
};
static_assert(Described<SegmentMergeOptions>);

class SegmentMerger {
 public:
  // Merges in place until nothing fits any more; the result is in order of falling length. Directions count:
  // an edge from bright to dark never joins one from dark to bright.
  void merge(std::vector<Segment2<double>>& segments, const SegmentMergeOptions& options) {
    const double max_tangent = std::tan(options.max_angle);
    for (bool changed = true; changed;) {
      changed = false;
      rods_.clear();
      for (const auto& s : segments)
        if (const double length = s.length(); length > 0) rods_.push_back({s, s.direction(), length});
      std::stable_sort(rods_.begin(), rods_.end(),
                       [](const Rod& a, const Rod& b) { return a.length > b.length; });
      segments.clear();
      std::size_t kept = 0;
      for (std::size_t i = 0; i < rods_.size(); ++i) {
        std::size_t into = 0;
        while (into < kept && !fit(rods_[into], rods_[i], max_tangent, options)) ++into;
        if (into < kept) {
          rods_[into] = joined(rods_[into], rods_[i]);
          changed = true;
        } else {
          rods_[kept++] = rods_[i];
        }
      }
      for (std::size_t i = 0; i < kept; ++i) segments.push_back(rods_[i].segment);
    }
  }

 private:
  struct Rod {
    Segment2<double> segment;
    Vec2<double> direction;
    double length;
  };

  [[nodiscard]] static bool fit(const Rod& longer, const Rod& shorter, double max_tangent,
                                const SegmentMergeOptions& options) noexcept {
    const Vec2<double>& d = longer.direction;
    const Vec2<double> to_start = shorter.segment.start - longer.segment.start;
    if (std::abs(cross(d, to_start)) > options.max_offset) return false;
    const double cosine = d.dot(shorter.direction);
    if (cosine <= 0 || std::abs(cross(d, shorter.direction)) > max_tangent * cosine) return false;
    const Vec2<double> to_end = shorter.segment.end - longer.segment.start;
    if (std::abs(cross(d, to_end)) > options.max_offset) return false;
    const double gap = std::max(to_start.dot(d) - longer.length, -to_end.dot(d));
    return gap <= std::min(options.max_gap, options.max_gap_ratio * longer.length);
  }

  // The principal axis of the two, taken as uniform rods, over the extent of both.
  [[nodiscard]] static Rod joined(const Rod& a, const Rod& b) noexcept {
    const Vec2<double> centre =
        (a.length * a.segment.midpoint() + b.length * b.segment.midpoint()) / (a.length + b.length);
    Mat2<double> scatter = Mat2<double>::Zero();
    for (const Rod* rod : {&a, &b}) {
      const Vec2<double> along = rod->segment.end - rod->segment.start,
                         off = rod->segment.midpoint() - centre;
      scatter += rod->length * (along * along.transpose() / 12 + off * off.transpose());
    }
    const Vec2<double> d = principal_axis(scatter(0, 0), scatter(0, 1), scatter(1, 1), a.direction);
    double low = 0, high = 0;
    for (const Vec2<double>* p : {&a.segment.start, &a.segment.end, &b.segment.start, &b.segment.end}) {
      low = std::min(low, d.dot(*p - centre));
      high = std::max(high, d.dot(*p - centre));
    }
    return {{centre + low * d, centre + high * d}, d, high - low};
  }

  std::vector<Rod> rods_;
};

}  // namespace sslam
