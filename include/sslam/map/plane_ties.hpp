// SPDX-License-Identifier: BSD-3-Clause
// The planes of a bundle adjustment's window: those that its points and lines lie on, with what holds them.
#pragma once

#include <span>
#include <vector>

#include "sslam/core/median.hpp"
#include "sslam/map/map.hpp"
#include "sslam/solver/bundle/bundle_graph.hpp"

namespace sslam {

// Keeps its buffers.
template <Scalar S>
class PlaneTies {
 public:
  std::vector<LandmarkId> planes;  // one for each graph.planes

  // Ties the graph's points and lines, which are those of the given ids in order, to their planes. Members
  // that are not in the graph hold a plane where it is, as keyframes around a window do.
  void add(const Map<S>& map, std::span<const LandmarkId> points, std::span<const LandmarkId> lines,
           bool manhattan, BundleGraph<S>& graph) {
    planes.clear();
    place_of_.assign(map.planes.size(), kNoPlane);
    for (std::size_t i = 0; i < points.size(); ++i)
      graph.points[i].plane = enter(map, map.points[map.index(points[i])]);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const LineLandmark<S>& line = map.lines[map.index(lines[i])];
      graph.lines[i].plane = enter(map, line);
      graph.lines[i].start = line.start;
      graph.lines[i].end = line.end;
    }
    if (planes.empty()) return;
    for (const LandmarkId id : planes) {
      const PlaneLandmark<S>& plane = map.planes[map.index(id)];
      graph.planes.push_back({plane.plane, std::nullopt, Mat<S, 4, 4>::Zero()});
      if (manhattan && plane.axis != kNone) graph.planes.back().axis = map.axis(plane.axis);
    }
    hold(map.points, &PlaneMembers::Lists::points, points, map, graph,
         [](const PointLandmark<S>& p, auto take) { take(p.position); });
    hold(map.lines, &PlaneMembers::Lists::lines, lines, map, graph, [](const LineLandmark<S>& l, auto take) {
      take(l.start);
      take(l.end);
    });
    graph.depth = depth_of(graph);
  }

 private:
  [[nodiscard]] std::int32_t enter(const Map<S>& map, const LandmarkCommon& landmark) {
    if (landmark.plane == kNone || !map.planes[map.index(landmark.plane)].alive) return kNoPlane;
    std::int32_t& place = place_of_[map.index(landmark.plane)];
    if (place == kNoPlane) {
      place = static_cast<std::int32_t>(planes.size());
      planes.push_back(landmark.plane);
    }
    return place;
  }

  template <class Landmarks, class Places>
  void hold(const Landmarks& landmarks, std::vector<LandmarkId> PlaneMembers::Lists::*kind,
            std::span<const LandmarkId> moving, const Map<S>& map, BundleGraph<S>& graph, Places places) {
    if (moves_.size() < landmarks.size()) moves_.resize(landmarks.size(), 0);
    for (const LandmarkId id : moving) moves_[map.index(id)] = 1;
    for (std::size_t p = 0; p < planes.size(); ++p)
      for (const LandmarkId id : map.members(planes[p]).*kind) {
        if (moves_[map.index(id)] != 0) continue;
        places(landmarks[map.index(id)], [&](const Vec3<S>& x) {
          Vec4<S> row;
          row << x, S(-1);
          graph.planes[p].held += row * row.transpose();
        });
      }
    for (const LandmarkId id : moving) moves_[map.index(id)] = 0;
  }

  // Median over the points and lines, each seen from one of its views.
  [[nodiscard]] S depth_of(const BundleGraph<S>& graph) {
    depths_.clear();
    const auto add = [&](const auto& landmark, const auto& edges, const Vec3<S>& x) {
      const auto view = edges[static_cast<std::size_t>(landmark.first_edge)].view;
      depths_.push_back((graph.views[static_cast<std::size_t>(view)].cam_from_world * x).z());
    };
    for (const BundlePoint<S>& p : graph.points) add(p, graph.point_edges, p.position);
    for (const BundleLine<S>& l : graph.lines) add(l, graph.line_edges, (l.start + l.end) / 2);
    const S depth = median<S>(depths_);
    return depth > 0 ? depth : S(1);
  }

  std::vector<std::int32_t> place_of_;  // by plane: its place in the graph, or kNoPlane
  std::vector<std::uint8_t> moves_;     // by landmark; all 0 between two kinds
  std::vector<S> depths_;
};

}  // namespace sslam
