// SPDX-License-Identifier: BSD-3-Clause
// Normal equations of a bundle adjustment: landmarks are eliminated, views and planes solved for.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "sslam/solver/bundle/bundle_graph.hpp"
#include "sslam/solver/bundle/landmark_elimination.hpp"
#include "sslam/solver/bundle/reduced_system.hpp"

namespace sslam {

template <Scalar S>
class BundleEquations {
 public:
  LandmarkSide<S, 3> points;
  LandmarkSide<S, 4> lines;

  void reset(const BundleGraph<S>& graph) {
    rows_.clear();
    turning_.clear();
    plane_rows_ = 0;
    for (const BundleView<S>& v : graph.views) {
      rows_.push_back(v.hold == Hold::kPose ? kHeld : plane_rows_);
      turning_.push_back(v.hold == Hold::kCentre ? 1 : 0);
      if (v.hold != Hold::kPose) plane_rows_ += 6;
    }
    views_.assign(graph.views.size(), {});
    planes_.assign(graph.planes.size(), {});
    points.reset(graph.points.size(), graph.point_edges.size());
    lines.reset(graph.lines.size(), graph.line_edges.size());
  }

  // The sink of BundleTerms.
  template <class Derive>
  void point(std::size_t i, std::size_t edge, std::size_t view, const Vec2<S>& error, S weight,
             Derive derive) {
    add_edge(points, i, edge, view, error, weight, derive);
  }
  template <class Derive>
  void line(std::size_t i, std::size_t edge, std::size_t view, const Vec2<S>& error, S weight,
            Derive derive) {
    add_edge(lines, i, edge, view, error, weight, derive);
  }
  void axis(std::size_t i, const Vec2<S>& error, S weight, const Mat<S, 2, 4>& by_line) {
    lines.landmarks[i].add(by_line, error, weight);
  }
  void point_on_plane(std::size_t i, std::size_t plane, const Vec<S, 1>& error, S weight,
                      const Mat<S, 1, 3>& by_plane, const Mat<S, 1, 3>& by_point) {
    add_tie(points, i, plane, error, weight, by_plane, by_point);
  }
  void line_on_plane(std::size_t i, std::size_t plane, const Vec2<S>& error, S weight,
                     const Mat<S, 2, 3>& by_plane, const Mat<S, 2, 4>& by_line) {
    add_tie(lines, i, plane, error, weight, by_plane, by_line);
  }
  void plane_held(std::size_t plane, const Mat3<S>& H, const Vec3<S>& g) {
    planes_[plane].H += H;
    planes_[plane].g += g;
  }
  void plane_axis(std::size_t plane, const Vec2<S>& error, S weight, const Mat<S, 2, 3>& by_plane) {
    planes_[plane].add(by_plane, error, weight);
  }
  void rotation(std::size_t view, const Vec3<S>& error, S weight, const Mat3<S>& by_rotation) {
    Mat<S, 3, 6> by_view = Mat<S, 3, 6>::Zero();
    by_view.template leftCols<3>() = by_rotation;
    views_[view].add(by_view, error, weight);
  }
  void scale(std::size_t view, S error, const Mat<S, 1, 6>& by_pose) {
    views_[view].add(by_pose, Vec<S, 1>(error), S(1));
  }

  // Steps of everything for a damping relative to the diagonal; false when the system of views and planes
  // cannot be factored.
  [[nodiscard]] bool solve(const BundleGraph<S>& graph, S damping) {
    const Eigen::Index size = plane_rows_ + static_cast<Eigen::Index>(3 * planes_.size());
    return size <= kDense ? solve(dense_, size, graph, damping) : solve(sparse_, size, graph, damping);
  }

  // The next graph is another one.
  void forget() noexcept { sparse_.forget(); }

  // Zero for a held view.
  [[nodiscard]] Vec6<S> view_step(std::size_t view) const {
    if (rows_[view] == kHeld) return Vec6<S>::Zero();
    return steps_.template segment<6>(rows_[view]);
  }
  [[nodiscard]] Vec3<S> plane_step(std::size_t plane) const {
    return steps_.template segment<3>(plane_row(plane));
  }

 private:
  static constexpr Eigen::Index kDense = 1200;  // rows: 200 views

  template <class System>
  [[nodiscard]] bool solve(System& system, Eigen::Index size, const BundleGraph<S>& graph, S damping) {
    system.begin(plane_rows_ / 6, static_cast<Eigen::Index>(planes_.size()));
    right_.resize(size);
    for (std::size_t v = 0; v < views_.size(); ++v)
      if (rows_[v] != kHeld) put<6>(system, views_[v], rows_[v], damping);
    for (std::size_t p = 0; p < planes_.size(); ++p) put<3>(system, planes_[p], plane_row(p), damping);
    for_each(graph.points, [&](auto i, auto first, auto last) {
      points.eliminate(i, first, last, damping, system, right_);
    });
    for_each(graph.lines, [&](auto i, auto first, auto last) {
      lines.eliminate(i, first, last, damping, system, right_);
    });
    for (std::size_t v = 0; v < rows_.size(); ++v)
      if (turning_[v] != 0)  // its gradient there is zero
        for (int a = 3; a < 6; ++a) system.block(rows_[v], rows_[v])[a * (system.stride(rows_[v]) + 1)] = 1;
    if (!system.solve(right_, steps_)) return false;
    steps_ = -steps_;
    if (!steps_.allFinite()) return false;
    for_each(graph.points, [&](auto i, auto first, auto last) { points.substitute(i, first, last, steps_); });
    for_each(graph.lines, [&](auto i, auto first, auto last) { lines.substitute(i, first, last, steps_); });
    return true;
  }

  template <int D, class Derive>
  void add_edge(LandmarkSide<S, D>& side, std::size_t i, std::size_t edge, std::size_t view,
                const Vec2<S>& error, S weight, Derive derive) {
    Mat<S, 2, 6> by_view;
    Mat<S, 2, D> by_landmark;
    derive(by_view, by_landmark);
    side.landmarks[i].add(by_landmark, error, weight);
    side.mixed[edge].row = rows_[view];
    if (rows_[view] == kHeld) return;
    if (turning_[view] != 0) by_view.template rightCols<3>().setZero();
    views_[view].add(by_view, error, weight);
    side.mixed[edge].W.setZero();
    add_product<S, 2, 6, D>(by_view, by_landmark, weight, side.mixed[edge].W);
  }

  template <int D, int Rows>
  void add_tie(LandmarkSide<S, D>& side, std::size_t i, std::size_t plane, const Vec<S, Rows>& error,
               S weight, const Mat<S, Rows, 3>& by_plane, const Mat<S, Rows, D>& by_landmark) {
    side.landmarks[i].add(by_landmark, error, weight);
    planes_[plane].add(by_plane, error, weight);
    side.planes[i].row = plane_row(plane);
    side.planes[i].W.setZero();
    add_product<S, Rows, 3, D>(by_plane, by_landmark, weight, side.planes[i].W);
  }

  template <int D, class System>
  void put(System& system, const BlockEquations<S, D>& block, Eigen::Index at, S damping) {
    S* const to = system.block(at, at);
    const Eigen::Index stride = system.stride(at);
    for (Eigen::Index c = 0; c < D; ++c) {
      for (Eigen::Index r = 0; r < D; ++r) to[c * stride + r] = block.H(r, c);
      to[c * stride + c] += damping * std::max(block.H(c, c), S(1e-9));
    }
    right_.template segment<D>(at) = block.g;
  }

  [[nodiscard]] Eigen::Index plane_row(std::size_t plane) const noexcept {
    return plane_rows_ + static_cast<Eigen::Index>(3 * plane);
  }

  template <class Landmarks, class F>
  static void for_each(const Landmarks& landmarks, F f) {
    for (std::size_t i = 0; i < landmarks.size(); ++i)
      f(i, static_cast<std::size_t>(landmarks[i].first_edge),
        static_cast<std::size_t>(landmarks[i].last_edge));
  }

  using VecX = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  std::vector<BlockEquations<S, 6>> views_;
  std::vector<BlockEquations<S, 3>> planes_;
  std::vector<Eigen::Index> rows_;     // by view: where it begins in the system, or kHeld
  Eigen::Index plane_rows_ = 0;        // where the planes begin
  std::vector<std::uint8_t> turning_;  // by view: 1 where the centre is held
  DenseSystem<S> dense_;
  SparseSystem<S> sparse_;
  VecX right_, steps_;
};

}  // namespace sslam
