// SPDX-License-Identifier: BSD-3-Clause
// The unknowns of a bundle adjustment, apart from the observations, so that a trial step leaves them as they
// were.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "sslam/solver/bundle/bundle_graph.hpp"

namespace sslam {

template <Scalar S>
struct BundleState {
  std::vector<SE3<S>> views;
  std::vector<Mat3<S>> rotations;  // of the views, as matrices
  std::vector<Vec3<S>> points;
  std::vector<Line3<S>> lines;
  std::vector<Plane3<S>> planes;

  void load(const BundleGraph<S>& graph) {
    views.clear();
    rotations.clear();
    points.clear();
    lines.clear();
    planes.clear();
    for (const auto& v : graph.views) views.push_back(v.cam_from_world);
    for (const auto& v : views) rotations.push_back(v.rotation.matrix());
    for (const auto& p : graph.points) points.push_back(p.position);
    for (const auto& l : graph.lines) lines.push_back(l.line);
    for (const auto& p : graph.planes) planes.push_back(p.plane);
  }

  void store(BundleGraph<S>& graph) const {
    for (std::size_t i = 0; i < views.size(); ++i)
      if (graph.views[i].hold != Hold::kPose) graph.views[i].cam_from_world = views[i];
    for (std::size_t i = 0; i < points.size(); ++i) graph.points[i].position = points[i];
    for (std::size_t i = 0; i < lines.size(); ++i) graph.lines[i].line = lines[i];
    for (std::size_t i = 0; i < planes.size(); ++i) graph.planes[i].plane = planes[i];
  }

  [[nodiscard]] bool finite() const noexcept {
    return std::all_of(views.begin(), views.end(),
                       [](const auto& v) {
                         return v.rotation.quaternion().coeffs().allFinite() && v.translation.allFinite();
                       }) &&
           std::all_of(points.begin(), points.end(), [](const auto& p) { return p.allFinite(); }) &&
           std::all_of(lines.begin(), lines.end(),
                       [](const auto& l) { return l.moment.allFinite() && l.direction.allFinite(); }) &&
           std::all_of(planes.begin(), planes.end(),
                       [](const auto& p) { return p.normal.allFinite() && std::isfinite(p.distance); });
  }
};

}  // namespace sslam
