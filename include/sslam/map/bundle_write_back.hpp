// SPDX-License-Identifier: BSD-3-Clause
// Takes the result of a bundle adjustment into the map: poses, landmarks, and which observations do not fit
// them.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "sslam/core/parameter.hpp"
#include "sslam/map/bundle_window.hpp"
#include "sslam/residual/line_on_plane.hpp"
#include "sslam/residual/line_reprojection.hpp"
#include "sslam/residual/point_on_plane.hpp"
#include "sslam/residual/point_reprojection.hpp"
#include "sslam/solver/bundle/bundle_ties.hpp"

namespace sslam {

template <Scalar S>
struct BundleWriteBackOptions {
  S point_gate =
      S(5.991);  // squared error in sigmas above which an observation goes: chi-square, 2 degrees, 95 %
  S line_gate = S(5.991);   // both endpoints together
  S axis_gate = S(13.8);    // above which a line no longer follows its axis, nor a plane: 99.9 %
  S plane_gate = S(10.8);   // above which a landmark no longer lies on its plane: 1 degree, 99.9 %
  S max_outliers = S(0.3);  // share of the observations; more than that and the result itself is not believed
  S min_ray_sine = S(0.1);  // angle between a ray and the line it trims, below which it says nothing

  template <class Self, class Visit>
  static void parameters(Self& self, Visit&& visit) {
    visit("point_gate", self.point_gate, Unit::kNumber, 0.01, kUnbounded,
          "chi-square beyond which a point's observation goes");
    visit("line_gate", self.line_gate, Unit::kNumber, 0.01, kUnbounded,
          "chi-square beyond which a line's observation goes");
    visit("axis_gate", self.axis_gate, Unit::kNumber, 0.01, kUnbounded,
          "chi-square beyond which a line or a plane leaves its axis");
    visit("plane_gate", self.plane_gate, Unit::kNumber, 0.01, kUnbounded,
          "chi-square beyond which a landmark leaves its plane");
    visit("max_outliers", self.max_outliers, Unit::kShare, 0, 1,
          "of the observations; with more, the result is not believed");
    visit("min_ray_sine", self.min_ray_sine, Unit::kShare, 0, 1,
          "sine of the angle between a ray and the line that it trims");
  }
};
static_assert(Described<BundleWriteBackOptions<double>>);

template <Scalar S>
class BundleWriteBack {
 public:
  BundleWriteBackOptions<S> options;

  // False, with the map untouched, when too few observations fit.
  bool write_back(const BundleWindow<S>& window, const BundleLosses<S>& losses, Map<S>& map) {
    find_outliers(window);
    const auto edges = window.graph.point_edges.size() + window.graph.line_edges.size();
    const auto outliers = point_outliers_.size() + line_outliers_.size();
    if (static_cast<S>(outliers) > options.max_outliers * static_cast<S>(edges)) return false;
    for (std::size_t v = 0; v < window.free_count; ++v)
      map.keyframes[map.index(window.keyframes[v])].cam_from_world = window.graph.views[v].cam_from_world;
    for (std::size_t i = 0; i < window.points.size(); ++i)
      map.points[map.index(window.points[i])].position = window.graph.points[i].position;
    for (std::size_t i = 0; i < window.lines.size(); ++i)
      map.lines[map.index(window.lines[i])].line = window.graph.lines[i].line;
    leave_planes(window, losses, map);
    for (const auto& [id, keyframe] : point_outliers_) map.forget_point(id, keyframe);
    for (const auto& [id, keyframe] : line_outliers_) map.forget_line(id, keyframe);
    for (const LandmarkId id : window.points) refresh_point(map, map.points[map.index(id)]);
    for (std::size_t i = 0; i < window.lines.size(); ++i)
      refresh_line(map, window.graph.lines[i], losses, map.lines[map.index(window.lines[i])]);
    return true;
  }

 private:
  void find_outliers(const BundleWindow<S>& window) {
    const BundleGraph<S>& graph = window.graph;
    point_outliers_.clear();
    line_outliers_.clear();
    for (std::size_t i = 0; i < graph.points.size(); ++i)
      for (auto e = graph.points[i].first_edge; e < graph.points[i].last_edge; ++e) {
        const PointEdge<S>& edge = graph.point_edges[Map<S>::index(e)];
        const BundleView<S>& view = graph.views[Map<S>::index(edge.view)];
        PointReprojection<S> r;
        const bool seen =
            point_reprojection(view.pinhole, view.cam_from_world, graph.points[i].position, edge.pixel, r);
        if (!seen || !((r.error * edge.inverse_sigma).squaredNorm() <= options.point_gate))
          point_outliers_.emplace_back(window.points[i], window.keyframes[Map<S>::index(edge.view)]);
      }
    for (std::size_t i = 0; i < graph.lines.size(); ++i)
      for (auto e = graph.lines[i].first_edge; e < graph.lines[i].last_edge; ++e) {
        const LineEdge<S>& edge = graph.line_edges[Map<S>::index(e)];
        const BundleView<S>& view = graph.views[Map<S>::index(edge.view)];
        LineReprojection<S> r;
        const bool seen =
            line_reprojection(view.pinhole, view.cam_from_world, graph.lines[i].line, edge.segment, r);
        if (!seen || !((r.error * edge.inverse_sigma).squaredNorm() <= options.line_gate))
          line_outliers_.emplace_back(window.lines[i], window.keyframes[Map<S>::index(edge.view)]);
      }
  }

  // Planes take their new places; what does not lie on its plane is a member no longer.
  void leave_planes(const BundleWindow<S>& window, const BundleLosses<S>& losses, Map<S>& map) const {
    const BundleGraph<S>& graph = window.graph;
    for (std::size_t p = 0; p < graph.planes.size(); ++p) {
      PlaneLandmark<S>& plane = map.planes[map.index(window.ties.planes[p])];
      plane.plane = graph.planes[p].plane;
      if (!graph.planes[p].axis) continue;
      const S off = axis_tie_residual(*graph.planes[p].axis, plane.plane).norm() / losses.axis_sigma;
      if (off * off > options.axis_gate) plane.axis = kNone;
    }
    const S sigma = losses.flatness * graph.depth;
    const auto gate = [&](S offset) { return offset * offset <= options.plane_gate * sigma * sigma; };
    for (std::size_t i = 0; i < graph.points.size(); ++i) {
      const BundlePoint<S>& point = graph.points[i];
      if (point.plane == kNoPlane) continue;
      const Plane3<S>& plane = graph.planes[map.index(point.plane)].plane;
      if (!gate(point_on_plane(plane, point.position).error[0])) map.lay_point(window.points[i], kNone);
    }
    for (std::size_t i = 0; i < graph.lines.size(); ++i) {
      const BundleLine<S>& line = graph.lines[i];
      if (line.plane == kNoPlane) continue;
      const Plane3<S>& plane = graph.planes[map.index(line.plane)].plane;
      if (!gate(line_on_plane(plane, line.line, line.start, line.end).error.cwiseAbs().maxCoeff()))
        map.lay_line(window.lines[i], kNone);
    }
  }

  // What the map keeps of a point's observers follows their poses.
  static void refresh_point(const Map<S>& map, PointLandmark<S>& point) {
    if (!point.alive) return;
    Vec3<S> sum = Vec3<S>::Zero();
    for (const Observation& o : point.observations) {
      const Keyframe<S>& kf = map.keyframes[map.index(o.keyframe)];
      const Vec3<S> to_camera = kf.cam_from_world.inverse().translation - point.position;
      const S distance = to_camera.norm();
      sum += to_camera / std::max(distance, S(1e-9));
      point.extent = kf.frame.points[map.index(o.feature)].sigma * distance;
    }
    point.viewing_direction = sum.normalized();
  }

  void refresh_line(const Map<S>& map, const BundleLine<S>& solved, const BundleLosses<S>& losses,
                    LineLandmark<S>& line) {
    if (!line.alive) return;
    if (solved.axis) {
      const S off = axis_tie_residual(*solved.axis, line.line).norm() / losses.axis_sigma;
      if (off * off > options.axis_gate) line.axis = kNone;
    }
    trim(map, line);
  }

  // The part of the line that its observers see; one in five of them may see too far at either end.
  void trim(const Map<S>& map, LineLandmark<S>& line) {
    const Vec3<S> origin = line.line.point_closest_to((line.start + line.end) / 2);
    const Vec3<S> along = (line.end - line.start).dot(line.line.direction) < 0 ? Vec3<S>(-line.line.direction)
                                                                               : line.line.direction;
    lows_.clear();
    highs_.clear();
    for (const Observation& o : line.observations) {
      const Keyframe<S>& kf = map.keyframes[map.index(o.keyframe)];
      const Segment2<S>& segment = kf.frame.lines[map.index(o.feature)].segment;
      S a, b;
      if (!place(kf, segment.start, line.line, origin, along, a) ||
          !place(kf, segment.end, line.line, origin, along, b))
        continue;
      lows_.push_back(std::min(a, b));
      highs_.push_back(std::max(a, b));
    }
    S low = (line.start - origin).dot(along), high = (line.end - origin).dot(along);
    if (!lows_.empty()) {
      const auto spare = static_cast<std::ptrdiff_t>(lows_.size() / 5);
      std::nth_element(lows_.begin(), lows_.begin() + spare, lows_.end());
      std::nth_element(highs_.begin(), highs_.end() - 1 - spare, highs_.end());
      low = lows_[Map<S>::index(static_cast<std::int32_t>(spare))];
      high = *(highs_.end() - 1 - spare);
    }
    line.start = origin + low * along;
    line.end = origin + high * along;
  }

  // Where along the line, from the origin, a pixel's ray comes closest to it.
  bool place(const Keyframe<S>& kf, const Vec2<S>& pixel, const Line3<S>& line, const Vec3<S>& origin,
             const Vec3<S>& along, S& out) const {
    const SE3<S> world_from_cam = kf.cam_from_world.inverse();
    const Vec3<S> ray = (world_from_cam.rotation * kf.frame.pinhole.unproject(pixel)).normalized();
    if (ray.cross(line.direction).norm() < options.min_ray_sine) return false;
    const Vec3<S> at = line.closest_to_ray(world_from_cam.translation, ray);
    if ((at - world_from_cam.translation).dot(ray) <= 0) return false;
    out = (at - origin).dot(along);
    return true;
  }

  std::vector<std::pair<LandmarkId, KeyframeId>> point_outliers_, line_outliers_;
  std::vector<S> lows_, highs_;
};

}  // namespace sslam
