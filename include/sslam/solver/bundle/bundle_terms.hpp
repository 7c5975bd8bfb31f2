// SPDX-License-Identifier: BSD-3-Clause
// Every term of a bundle adjustment in turn, in standard deviations and with its robust loss.
#pragma once

#include <cmath>
#include <limits>
#include <span>

#include "sslam/residual/line_on_plane.hpp"
#include "sslam/residual/line_reprojection.hpp"
#include "sslam/residual/loss.hpp"
#include "sslam/residual/point_on_plane.hpp"
#include "sslam/residual/point_reprojection.hpp"
#include "sslam/solver/bundle/bundle_state.hpp"
#include "sslam/solver/bundle/bundle_ties.hpp"

namespace sslam {

// Which edges take part. Those that cannot be evaluated at the start are left out; after that the choice
// stands, so that costs can be compared.
struct ActiveEdges {
  std::vector<std::uint8_t> points, lines;  // one for each edge
};

// Calls the sink with each term's residual and, in a callable, its derivatives; sums rho over all of them.
// Infinity when an active edge cannot be evaluated.
template <Scalar S, class Sink>
class BundleTerms {
 public:
  BundleTerms(const BundleGraph<S>& graph, const BundleState<S>& state, const BundleLosses<S>& losses,
              Sink& sink)
      : graph_(graph), state_(state), losses_(losses), sink_(sink) {}

  [[nodiscard]] S visit(const ActiveEdges& active) {
    S cost = visit_points(active.points) + visit_lines(active.lines);
    for (std::size_t p = 0; p < graph_.planes.size(); ++p) cost += visit_plane(p);
    for (std::size_t v = 0; v < graph_.views.size(); ++v) cost += visit_rotation(v);
    return cost + visit_scale();
  }

 private:
  static constexpr S kRefused = std::numeric_limits<S>::infinity();

  [[nodiscard]] S visit_points(std::span<const std::uint8_t> active) {
    const CauchyLoss<S> loss{losses_.point};
    S cost = 0;
    for (std::size_t i = 0; i < graph_.points.size(); ++i) {
      for (auto e = to_index(graph_.points[i].first_edge); e < to_index(graph_.points[i].last_edge); ++e) {
        if (active[e] == 0) continue;
        const PointEdge<S>& edge = graph_.point_edges[e];
        const auto v = to_index(edge.view);
        PointReprojection<S> seen;
        if (!point_reprojection(graph_.views[v].pinhole, state_.views[v], state_.points[i], edge.pixel, seen))
          return kRefused;
        const Vec2<S> error = edge.inverse_sigma * seen.error;
        const S squared = error.squaredNorm();
        cost += loss.rho(squared);
        sink_.point(i, e, v, error, loss.weight(squared), [&](Mat<S, 2, 6>& by_view, Mat<S, 2, 3>& by_point) {
          seen.wrt_camera_point *= edge.inverse_sigma;
          by_view = seen.wrt_pose();
          by_point = seen.wrt_point(state_.rotations[v]);
        });
      }
      if (graph_.points[i].plane != kNoPlane) cost += visit_point_on_plane(i);
    }
    return cost;
  }

  [[nodiscard]] S visit_lines(std::span<const std::uint8_t> active) {
    const CauchyLoss<S> loss{losses_.line};
    S cost = 0;
    for (std::size_t i = 0; i < graph_.lines.size(); ++i) {
      for (auto e = to_index(graph_.lines[i].first_edge); e < to_index(graph_.lines[i].last_edge); ++e) {
        if (active[e] == 0) continue;
        const LineEdge<S>& edge = graph_.line_edges[e];
        const auto v = to_index(edge.view);
        LineReprojection<S> seen;
        if (!line_reprojection(graph_.views[v].pinhole, state_.views[v], state_.lines[i], edge.segment, seen))
          return kRefused;
        const Vec2<S> error = edge.inverse_sigma * seen.error;
        const S squared = error.squaredNorm();
        cost += loss.rho(squared);
        sink_.line(i, e, v, error, loss.weight(squared), [&](Mat<S, 2, 6>& by_view, Mat<S, 2, 4>& by_line) {
          seen.wrt_moment *= edge.inverse_sigma;
          by_view = seen.wrt_pose();
          by_line = seen.wrt_line(state_.views[v], state_.lines[i]);
        });
      }
      if (graph_.lines[i].axis) cost += visit_axis(i);
      if (graph_.lines[i].plane != kNoPlane) cost += visit_line_on_plane(i);
    }
    return cost;
  }

  [[nodiscard]] S visit_axis(std::size_t i) {
    const CauchyLoss<S> loss{losses_.axis};
    const S inverse_sigma = 1 / losses_.axis_sigma;
    Mat<S, 2, 4> derivative;
    const Vec2<S> error =
        inverse_sigma * axis_tie_residual(*graph_.lines[i].axis, state_.lines[i], &derivative);
    const S squared = error.squaredNorm();
    sink_.axis(i, error, loss.weight(squared), Mat<S, 2, 4>(inverse_sigma * derivative));
    return loss.rho(squared);
  }

  [[nodiscard]] S inverse_plane_sigma() const { return 1 / (losses_.flatness * graph_.depth); }

  [[nodiscard]] S visit_point_on_plane(std::size_t i) {
    const CauchyLoss<S> loss{losses_.plane};
    const S inverse_sigma = inverse_plane_sigma();
    const auto plane = to_index(graph_.points[i].plane);
    PointOnPlane<S> tie = point_on_plane(state_.planes[plane], state_.points[i]);
    tie.error *= inverse_sigma;
    const S squared = tie.error.squaredNorm();
    sink_.point_on_plane(i, plane, tie.error, loss.weight(squared),
                         Mat<S, 1, 3>(inverse_sigma * tie.wrt_plane),
                         Mat<S, 1, 3>(inverse_sigma * tie.wrt_point));
    return loss.rho(squared);
  }

  [[nodiscard]] S visit_line_on_plane(std::size_t i) {
    const CauchyLoss<S> loss{losses_.plane};
    const S inverse_sigma = inverse_plane_sigma();
    const BundleLine<S>& line = graph_.lines[i];
    const auto plane = to_index(line.plane);
    LineOnPlane<S> tie = line_on_plane(state_.planes[plane], state_.lines[i], line.start, line.end);
    tie.error *= inverse_sigma;
    const S squared = tie.error.squaredNorm();
    sink_.line_on_plane(i, plane, tie.error, loss.weight(squared),
                        Mat<S, 2, 3>(inverse_sigma * tie.wrt_plane),
                        Mat<S, 2, 4>(inverse_sigma * tie.wrt_line));
    return loss.rho(squared);
  }

  // What holds the plane itself: its axis, and the members that stay.
  [[nodiscard]] S visit_plane(std::size_t p) {
    const Plane3<S>& plane = state_.planes[p];
    const S inverse_variance = inverse_plane_sigma() * inverse_plane_sigma();
    Vec4<S> stacked;
    stacked << plane.normal, plane.distance;
    const Mat<S, 4, 3> by_tangent = plane.retract_jacobian();
    const Vec4<S> pull = inverse_variance * (graph_.planes[p].held * stacked);
    const Mat3<S> H = inverse_variance * by_tangent.transpose() * graph_.planes[p].held * by_tangent;
    sink_.plane_held(p, H, Vec3<S>(by_tangent.transpose() * pull));
    const S cost = stacked.dot(pull);
    if (!graph_.planes[p].axis) return cost;
    const CauchyLoss<S> loss{losses_.axis};
    const S inverse_sigma = 1 / losses_.axis_sigma;
    Mat<S, 2, 3> derivative;
    const Vec2<S> error = inverse_sigma * axis_tie_residual(*graph_.planes[p].axis, plane, &derivative);
    const S squared = error.squaredNorm();
    sink_.plane_axis(p, error, loss.weight(squared), Mat<S, 2, 3>(inverse_sigma * derivative));
    return cost + loss.rho(squared);
  }

  [[nodiscard]] S visit_rotation(std::size_t v) {
    const BundleView<S>& view = graph_.views[v];
    if (!view.rotation || view.hold == Hold::kPose) return 0;
    const CauchyLoss<S> loss{losses_.rotation};
    Mat3<S> derivative;
    const Vec3<S> error = rotation_tie_residual(*view.rotation, state_.views[v].rotation, &derivative);
    const S squared = error.squaredNorm();
    sink_.rotation(v, error, loss.weight(squared), derivative);
    return loss.rho(squared);
  }

  [[nodiscard]] S visit_scale() {
    if (!graph_.scale) return 0;
    const Vec3<S> held = state_.views[to_index(graph_.scale->held)].inverse().translation;
    const auto v = to_index(graph_.scale->free);
    const S inverse_sigma = 1 / losses_.scale_sigma;
    Mat<S, 1, 6> derivative;
    const S error =
        inverse_sigma * scale_tie_residual(held, graph_.scale->distance, state_.views[v], &derivative);
    sink_.scale(v, error, Mat<S, 1, 6>(inverse_sigma * derivative));
    return error * error;
  }

  [[nodiscard]] static std::size_t to_index(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

  const BundleGraph<S>& graph_;
  const BundleState<S>& state_;
  const BundleLosses<S>& losses_;
  Sink& sink_;
};

// A sink for the cost alone.
struct CostOnly {
  template <class... Args>
  void point(const Args&...) const noexcept {}
  template <class... Args>
  void line(const Args&...) const noexcept {}
  template <class... Args>
  void axis(const Args&...) const noexcept {}
  template <class... Args>
  void point_on_plane(const Args&...) const noexcept {}
  template <class... Args>
  void line_on_plane(const Args&...) const noexcept {}
  template <class... Args>
  void plane_held(const Args&...) const noexcept {}
  template <class... Args>
  void plane_axis(const Args&...) const noexcept {}
  template <class... Args>
  void rotation(const Args&...) const noexcept {}
  template <class... Args>
  void scale(const Args&...) const noexcept {}
};

}  // namespace sslam
