// SPDX-License-Identifier: BSD-3-Clause
// The part of a plane that its members cover: a rectangle in the plane, spread along their principal
// directions.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "sslam/map/map.hpp"

namespace sslam {

template <Scalar S>
struct PlaneExtent {
  Mat<S, 3, 2> basis = Mat<S, 3, 2>::Zero();  // unit, world: across the normal
  Vec2<S> low = Vec2<S>::Constant(std::numeric_limits<S>::infinity()), high = -low;
  Vec2<S> sum = Vec2<S>::Zero();
  Mat<S, 2, 2> squares = Mat<S, 2, 2>::Zero();
  int places = 0;

  explicit PlaneExtent(const Vec3<S>& normal) : basis(tangent_basis(normal)) {}

  void add(const Vec3<S>& x) {
    const Vec2<S> u = basis.transpose() * x;
    low = low.cwiseMin(u);
    high = high.cwiseMax(u);
    sum += u;
    squares += u * u.transpose();
    ++places;
  }
  void add(const PointLandmark<S>& point) { add(point.position); }
  void add(const LineLandmark<S>& line) {
    add(line.start);
    add(line.end);
  }

  // Whether the point, seen along the normal, lies in the rectangle or within `reach` of it.
  [[nodiscard]] bool covers(const Vec3<S>& x, S reach) const {
    const Vec2<S> u = basis.transpose() * x;
    return (u.array() >= low.array() - reach).all() && (u.array() <= high.array() + reach).all();
  }
  [[nodiscard]] bool meets(const PlaneExtent& other, S reach) const {
    return (low.array() - reach <= other.high.array()).all() &&
           (high.array() + reach >= other.low.array()).all();
  }

  // Standard deviation of the places in the direction of the plane in which they spread least: near zero
  // where they lie on a line, which no plane follows from.
  [[nodiscard]] S least_spread() const {
    if (places < 3) return 0;
    const Vec2<S> mean = sum / static_cast<S>(places);
    const Mat<S, 2, 2> c = squares / static_cast<S>(places) - mean * mean.transpose();
    const S half = c.trace() / 2;
    const S gap = std::sqrt(std::max(S(0), half * half - c.determinant()));
    return std::sqrt(std::max(S(0), half - gap));
  }

  // Corners of the rectangle on the plane, in order around it.
  [[nodiscard]] std::array<Vec3<S>, 4> corners(const Plane3<S>& plane) const {
    const auto at = [&](S u, S v) -> Vec3<S> {
      return plane.distance * plane.normal + basis * Vec2<S>(u, v);
    };
    return {at(low.x(), low.y()), at(high.x(), low.y()), at(high.x(), high.y()), at(low.x(), high.y())};
  }
};

// What of a plane its members cover.
template <Scalar S>
[[nodiscard]] PlaneExtent<S> extent_of(const Map<S>& map, LandmarkId plane) {
  PlaneExtent<S> extent(map.planes[map.index(plane)].plane.normal);
  for (const LandmarkId id : map.members(plane).points) extent.add(map.points[map.index(id)]);
  for (const LandmarkId id : map.members(plane).lines) extent.add(map.lines[map.index(id)]);
  return extent;
}

// Of each plane, by id.
template <Scalar S>
void gather_extents(const Map<S>& map, std::vector<PlaneExtent<S>>& extents) {
  extents.clear();
  for (std::size_t p = 0; p < map.planes.size(); ++p)
    extents.push_back(extent_of(map, static_cast<LandmarkId>(p)));
}

}  // namespace sslam
