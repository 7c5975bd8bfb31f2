// SPDX-License-Identifier: BSD-3-Clause
// The floor of a map: the lowest level surface that its landmarks show below the cameras.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "sslam/core/median.hpp"
#include "sslam/core/random.hpp"
#include "sslam/map/depth_ratios.hpp"
#include "sslam/map/map.hpp"
#include "sslam/map/vertical.hpp"

namespace sslam {

template <Scalar S>
struct FloorOptions {
  S max_lean = radians(S(40));  // between the vertical and the mean of the cameras' y axes
  S thickness = S(0.03);        // half of it, over the height of the cameras; up to twice as much is tried
  S contrast = S(1.6);          // landmarks in the layer over those in as thick a layer above it
  S sigmas = S(3);              // by which the layer has more of them, against chance
  S max_below = S(0.3);         // landmarks below the layer over those in it: under a floor there is nothing
  int min_support = 20;         // landmarks in it
  int samples = 400;            // triples that are tried where no Manhattan axis is vertical
};

enum class FloorStatus {
  kFound,
  kNoVertical,  // the cameras look up, down or are rolled so much that down is not known
  kNoLayer,     // landmarks below the cameras are few, or lie in no layer
};

[[nodiscard]] constexpr const char* name(FloorStatus status) noexcept {
  switch (status) {
    case FloorStatus::kFound:
      return "found";
    case FloorStatus::kNoVertical:
      return "which way is down is not known: the cameras are rolled, or look up or down";
    case FloorStatus::kNoLayer:
      return "no level layer of landmarks lies below the path";
  }
  return "";
}

template <Scalar S>
struct Floor {
  FloorStatus status = FloorStatus::kNoLayer;
  Plane3<S> plane;      // its normal points up
  int support = 0;      // landmarks in it
  S camera_height = 0;  // median over the keyframes, units of the map
  S spread = 0;         // share of it by which the keyframes' heights differ (CommonRatio)
};

namespace floor_detail {

template <Scalar S>
[[nodiscard]] std::vector<Vec3<S>> gather_centres(const Map<S>& map) {
  std::vector<Vec3<S>> centres;
  for (const Keyframe<S>& kf : map.keyframes)
    if (kf.alive()) centres.push_back(kf.cam_from_world.inverse().translation);
  return centres;
}

// Points, and both ends of lines.
template <Scalar S>
[[nodiscard]] std::vector<Vec3<S>> gather_places(const Map<S>& map) {
  std::vector<Vec3<S>> places;
  for (const PointLandmark<S>& point : map.points)
    if (point.alive) places.push_back(point.position);
  for (const LineLandmark<S>& line : map.lines) {
    if (!line.alive) continue;
    places.push_back(line.start);
    places.push_back(line.end);
  }
  return places;
}

template <Scalar S>
[[nodiscard]] S median_along(const std::vector<Vec3<S>>& places, const Vec3<S>& direction) {
  std::vector<S> heights;
  heights.reserve(places.size());
  for (const Vec3<S>& place : places) heights.push_back(direction.dot(place));
  return median<S>(heights);
}

// The normal of the plane through three places below the cameras that most others lie on, of those near to
// `down`; `down` itself where there is none.
template <Scalar S>
[[nodiscard]] Vec3<S> vertical_of_places(const std::vector<Vec3<S>>& places,
                                         const std::vector<Vec3<S>>& centres, const Vec3<S>& down,
                                         const FloorOptions<S>& options) {
  const S eye = median_along(centres, down);
  std::vector<Vec3<S>> below;
  for (const Vec3<S>& place : places)
    if (down.dot(place) > eye) below.push_back(place);
  Vec3<S> best = down;
  if (below.size() < 3) return best;
  Random random(1);
  const auto draw = [&] { return below[random.below(static_cast<std::uint32_t>(below.size()))]; };
  std::ptrdiff_t most = 0;
  for (int i = 0; i < options.samples; ++i) {
    const Vec3<S> a = draw(), b = draw(), c = draw();
    Vec3<S> normal = (b - a).cross(c - a).normalized();
    if (normal.dot(down) < 0) normal = -normal;
    if (!(normal.dot(down) > std::cos(options.max_lean))) continue;
    const S layer = options.thickness * (normal.dot(a) - median_along(centres, normal));
    const std::ptrdiff_t support = std::count_if(
        below.begin(), below.end(), [&](const Vec3<S>& x) { return std::abs(normal.dot(x - a)) <= layer; });
    if (support <= most) continue;
    most = support;
    best = normal;
  }
  return best;
}

// The lowest layer among depths below the cameras, which are in order: where it begins and ends in the list;
// nothing: both 0. A wall alone has no layer: landmarks are as many above it.
template <Scalar S>
[[nodiscard]] std::pair<std::size_t, std::size_t> lowest_layer(const std::vector<S>& depths,
                                                               const FloorOptions<S>& options) {
  const auto from = [&](S depth) {
    return static_cast<std::size_t>(std::lower_bound(depths.begin(), depths.end(), depth) - depths.begin());
  };
  const auto layer_at = [&](S depth) {
    return std::pair(from(depth * (1 - options.thickness)), from(depth * (1 + options.thickness)));
  };
  for (std::size_t i = depths.size(); i-- > 0;) {
    const auto [first, last] = layer_at(depths[i]);
    const S inside = static_cast<S>(last - first);
    const S above = static_cast<S>(first - from(depths[i] * (1 - 5 * options.thickness))) / 2;
    const S below = static_cast<S>(depths.size() - last);
    if (inside < static_cast<S>(options.min_support) || inside < options.contrast * above ||
        inside - above < options.sigmas * std::sqrt(inside + above) || below > options.max_below * inside)
      continue;
    // Its edge was found: the layer is where most are.
    std::pair best(first, last);
    for (std::size_t k = i; k-- > 0 && depths[k] > depths[i] * (1 - 2 * options.thickness);) {
      const auto other = layer_at(depths[k]);
      if (other.second - other.first > best.second - best.first) best = other;
    }
    return best;
  }
  return {0, 0};
}

// Landmarks of a short walk scatter more than the layer is thick, and spill over its edges.
template <Scalar S>
[[nodiscard]] std::pair<std::size_t, std::size_t> thinnest_layer(const std::vector<S>& depths,
                                                                 FloorOptions<S> options) {
  const S thickest = 2 * options.thickness;
  for (; options.thickness <= thickest; options.thickness *= S(1.25))
    if (const auto layer = lowest_layer(depths, options); layer.first != layer.second) return layer;
  return {0, 0};
}

}  // namespace floor_detail

// Cameras are taken to be held upright on the whole. The vertical is the Manhattan axis nearest to their y
// axes, or else the normal of the plane that most landmarks below them lie on.
template <Scalar S>
[[nodiscard]] Floor<S> find_floor(const Map<S>& map, const FloorOptions<S>& options = {}) {
  namespace detail = floor_detail;
  Floor<S> floor;
  const std::vector<Vec3<S>> centres = detail::gather_centres(map);
  const Vec3<S> cameras_down = mean_down(map);
  if (centres.empty() || !(cameras_down.norm() > std::cos(options.max_lean))) {
    floor.status = FloorStatus::kNoVertical;
    return floor;
  }
  const std::vector<Vec3<S>> places = detail::gather_places(map);
  const Vec3<S> mean = cameras_down.normalized();
  Vec3<S> down = vertical_axis<S>(map.world_from_manhattan, mean, options.max_lean);
  if (down.isZero()) down = detail::vertical_of_places(places, centres, mean, options);
  const S eye = detail::median_along(centres, down);
  std::vector<S> depths;
  for (const Vec3<S>& place : places)
    if (const S depth = down.dot(place) - eye; depth > 0) depths.push_back(depth);
  std::sort(depths.begin(), depths.end());
  const auto [first, last] = detail::thinnest_layer(depths, options);
  if (last == first) return floor;
  const S level = eye + depths[first + (last - first) / 2];
  std::vector<S> heights;
  for (const Vec3<S>& centre : centres)
    if (const S height = level - down.dot(centre); height > 0) heights.push_back(height);
  const CommonRatio<S> common = common_ratio<S>(heights);
  floor.status = FloorStatus::kFound;
  floor.plane = {-down, -level};
  floor.support = static_cast<int>(last - first);
  floor.camera_height = common.value;
  floor.spread = common.spread;
  return floor;
}

}  // namespace sslam
