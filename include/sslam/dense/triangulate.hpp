// SPDX-License-Identifier: BSD-3-Clause
// Polygons with fewer corners, and as triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "sslam/dense/cell_outline.hpp"

namespace sslam::dense {

namespace detail {

[[nodiscard]] inline double cross(const Vec2<double>& a, const Vec2<double>& b, const Vec2<double>& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

[[nodiscard]] inline double distance_to(const Vec2<double>& p, const Vec2<double>& a, const Vec2<double>& b) {
  const Vec2<double> d = b - a;
  const double length2 = d.squaredNorm();
  const double share = length2 > 0 ? std::clamp((p - a).dot(d) / length2, 0.0, 1.0) : 0;
  return (p - a - share * d).norm();
}

// Douglas and Peucker 1973, of the corners [first, last] of a ring, without the last.
inline void thin(const Ring& ring, std::size_t first, std::size_t last, double tolerance, Ring& out) {
  const auto at = [&](std::size_t i) -> const Vec2<double>& { return ring[i % ring.size()]; };
  std::size_t far = first;
  double most = tolerance;
  for (std::size_t i = first + 1; i < last; ++i)
    if (const double d = distance_to(at(i), at(first), at(last)); d > most) {
      most = d;
      far = i;
    }
  if (far == first) {
    out.push_back(at(first));
    return;
  }
  thin(ring, first, far, tolerance, out);
  thin(ring, far, last, tolerance, out);
}

}  // namespace detail

// A ring whose edges pass within `tolerance` of the corners that are left out.
[[nodiscard]] inline Ring simplify(const Ring& ring, double tolerance) {
  if (ring.size() < 4) return ring;
  // From the two corners that are farthest apart, seen from the first: they stay.
  const auto farthest = [&](std::size_t from) {
    std::size_t best = from;
    for (std::size_t i = 0; i < ring.size(); ++i)
      if ((ring[i] - ring[from]).squaredNorm() > (ring[best] - ring[from]).squaredNorm()) best = i;
    return best;
  };
  std::size_t a = farthest(0), b = farthest(a);
  if (a > b) std::swap(a, b);
  Ring out;
  detail::thin(ring, a, b, tolerance, out);
  detail::thin(ring, b, a + ring.size(), tolerance, out);
  return out;
}

using Triangle = std::array<std::uint32_t, 3>;

// Corners of a polygon and its triangles, counter-clockwise: holes are joined to the ring around them by a
// cut to the nearest corner that they see, then ears are cut off (Eberly, "Triangulation by ear clipping").
class Triangulator {
 public:
  std::vector<Vec2<double>> corners;
  std::vector<Triangle> triangles;

  explicit Triangulator(const Polygon& polygon) {
    for (const Vec2<double>& p : polygon.outer) ring_.push_back(add(p));
    std::vector<const Ring*> holes;
    for (const Ring& hole : polygon.holes) holes.push_back(&hole);
    // From right to left, so that a cut meets no hole that is not joined yet.
    const auto right = [](const Ring& hole) {
      return *std::max_element(hole.begin(), hole.end(),
                               [](const auto& a, const auto& b) { return a.x() < b.x(); });
    };
    std::stable_sort(holes.begin(), holes.end(),
                     [&](const Ring* a, const Ring* b) { return right(*a).x() > right(*b).x(); });
    for (const Ring* const hole : holes) join(*hole);
    clip();
  }

 private:
  std::uint32_t add(const Vec2<double>& p) {
    corners.push_back(p);
    return static_cast<std::uint32_t>(corners.size() - 1);
  }

  [[nodiscard]] bool crosses(const Vec2<double>& a, const Vec2<double>& b,
                             const std::vector<std::uint32_t>& ring) const {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2<double>&c = corners[ring[i]], &d = corners[ring[(i + 1) % ring.size()]];
      if (c == a || c == b || d == a || d == b) continue;
      if (detail::cross(a, b, c) * detail::cross(a, b, d) <= 0 &&
          detail::cross(c, d, a) * detail::cross(c, d, b) <= 0)
        return true;
    }
    return false;
  }

  void join(const Ring& hole) {
    std::vector<std::uint32_t> inner;
    for (const Vec2<double>& p : hole) inner.push_back(add(p));
    std::size_t from = 0;
    for (std::size_t i = 0; i < hole.size(); ++i)
      if (hole[i].x() > hole[from].x()) from = i;
    std::size_t best = ring_.size();
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      const Vec2<double>& p = corners[ring_[i]];
      const double d = (p - hole[from]).squaredNorm();
      if (d < nearest && !crosses(hole[from], p, ring_) && !crosses(hole[from], p, inner) &&
          within(i, hole[from])) {
        nearest = d;
        best = i;
      }
    }
    if (best == ring_.size()) return;  // a degenerate hole is left closed
    std::rotate(inner.begin(), inner.begin() + static_cast<std::ptrdiff_t>(from), inner.end());
    inner.push_back(inner.front());
    inner.push_back(ring_[best]);
    ring_.insert(ring_.begin() + static_cast<std::ptrdiff_t>(best) + 1, inner.begin(), inner.end());
  }

  // Whether the point lies in the ring's inner angle at corner i: of corners that a cut has doubled, the one
  // on its side.
  [[nodiscard]] bool within(std::size_t i, const Vec2<double>& p) const {
    const std::size_t n = ring_.size();
    const Vec2<double>&a = corners[ring_[(i + n - 1) % n]], &b = corners[ring_[i]],
          &c = corners[ring_[(i + 1) % n]];
    if (detail::cross(a, b, c) >= 0) return detail::cross(a, b, p) >= 0 && detail::cross(b, c, p) >= 0;
    return detail::cross(a, b, p) >= 0 || detail::cross(b, c, p) >= 0;
  }

  [[nodiscard]] bool is_ear(std::size_t i) const {
    const std::size_t n = ring_.size();
    const Vec2<double>&a = corners[ring_[(i + n - 1) % n]], &b = corners[ring_[i]],
          &c = corners[ring_[(i + 1) % n]];
    if (!(detail::cross(a, b, c) > 0)) return false;
    for (const std::uint32_t k : ring_) {
      const Vec2<double>& p = corners[k];
      if (p == a || p == b || p == c) continue;
      if (detail::cross(a, b, p) >= 0 && detail::cross(b, c, p) >= 0 && detail::cross(c, a, p) >= 0)
        return false;
    }
    return true;
  }

  void clip() {
    while (ring_.size() > 3) {
      std::size_t ear = ring_.size();
      for (std::size_t i = 0; i < ring_.size() && ear == ring_.size(); ++i)
        if (is_ear(i)) ear = i;
      if (ear == ring_.size()) ear = flattest();
      cut(ear);
    }
    if (ring_.size() == 3) cut(0);
  }

  // Where rounding has left no ear, the corner that encloses next to nothing goes.
  [[nodiscard]] std::size_t flattest() const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      const std::size_t n = ring_.size();
      const double area = std::abs(
          detail::cross(corners[ring_[(i + n - 1) % n]], corners[ring_[i]], corners[ring_[(i + 1) % n]]));
      if (area < least) {
        least = area;
        best = i;
      }
    }
    return best;
  }

  void cut(std::size_t i) {
    const std::size_t n = ring_.size();
    const Triangle t{ring_[(i + n - 1) % n], ring_[i], ring_[(i + 1) % n]};
    if (detail::cross(corners[t[0]], corners[t[1]], corners[t[2]]) > 0) triangles.push_back(t);
    ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(i));
  }

  std::vector<std::uint32_t> ring_;
};

}  // namespace sslam::dense
