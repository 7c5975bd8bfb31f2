// SPDX-License-Identifier: BSD-3-Clause
// Measured depth over the map's depth: how many metres a unit of the map is.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "sslam/core/median.hpp"
#include "sslam/map/landmark_precision.hpp"
#include "sslam/map/map.hpp"

namespace sslam {

// Metres over units of the map, one for each landmark that the keyframe observes and that lies sharply enough
// along its ray: its standard deviation there is at most `max_sigma` of the distance. depth_at(pixel) is the
// measured depth along the optical axis at an undistorted pixel, metres; 0 or less: none.
template <Scalar S, class DepthAt>
[[nodiscard]] std::vector<S> depth_ratios(const Map<S>& map, const Keyframe<S>& kf, DepthAt depth_at,
                                          S max_sigma = S(0.05)) {
  std::vector<S> ratios;
  const Vec3<S> centre = kf.cam_from_world.inverse().translation;
  for (std::size_t i = 0; i < kf.point_landmarks.size(); ++i) {
    if (kf.point_landmarks[i] == kNone) continue;
    const PointLandmark<S>& point = map.points[map.index(kf.point_landmarks[i])];
    const S z = (kf.cam_from_world * point.position).z();
    if (!(z > 0)) continue;
    const S depth = depth_at(kf.frame.points[i].pixel);
    if (!(depth > 0)) continue;
    const Vec3<S> ray = point.position - centre;
    const S distance = ray.norm();
    if (sigma_along(map, point, Vec3<S>(ray / distance)) <= max_sigma * distance) ratios.push_back(depth / z);
  }
  return ratios;
}

// What positive numbers have in common.
template <Scalar S>
struct CommonRatio {
  S value = 0;   // their median
  S spread = 0;  // share of it that they differ by: the robust standard deviation (1.4826 times the median
                 // distance from the median) of their logarithms
};

// Of one number at least. Reorders them.
template <Scalar S>
[[nodiscard]] CommonRatio<S> common_ratio(std::span<S> ratios) noexcept {
  CommonRatio<S> common;
  common.value = median(ratios);
  for (S& ratio : ratios) ratio = std::abs(std::log(ratio / common.value));
  common.spread = S(1.4826) * median(ratios);
  return common;
}

}  // namespace sslam
