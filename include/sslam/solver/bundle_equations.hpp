// SPDX-License-Identifier: BSD-3-Clause
// Normal equations of a bundle adjustment, kept by block, and their solution by elimination of the landmarks
// (Schur complement; Triggs et al., Bundle Adjustment - A Modern Synthesis, 2000, section 6.1).
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

#include "sslam/solver/block_kernels.hpp"
#include "sslam/solver/bundle_graph.hpp"
#include "sslam/solver/positive_inverse.hpp"

namespace sslam {

template <Scalar S, int D>
struct BlockEquations {
  Mat<S, D, D> H = Mat<S, D, D>::Zero();
  Vec<S, D> g = Vec<S, D>::Zero();

  template <int Rows>
  void add(const Mat<S, Rows, D>& derivative, const Vec<S, Rows>& error, S weight) noexcept {
    add_square<S, Rows, D>(derivative, weight, H);
    add_product<S, Rows, D>(derivative, error, weight, g);
  }
};

// The mixed block of a landmark and what is not eliminated, a view or a plane: it begins at `row` of the
// reduced system, or nowhere (kHeld) when it does not move.
template <Scalar S, int Rows, int D>
struct MixedBlock {
  Mat<S, Rows, D> W;
  Eigen::Index row;
};
inline constexpr Eigen::Index kHeld = -1;

template <Scalar S, int D>
class LandmarkSide {
 public:
  std::vector<BlockEquations<S, D>> landmarks;
  std::vector<MixedBlock<S, 6, D>> mixed;   // one for each edge
  std::vector<MixedBlock<S, 3, D>> planes;  // one for each landmark
  std::vector<Vec<S, D>> steps;

  void reset(std::size_t landmark_count, std::size_t edge_count) {
    landmarks.assign(landmark_count, {});
    mixed.resize(edge_count);
    for (auto& m : mixed) m.row = kHeld;
    planes.resize(landmark_count);
    for (auto& m : planes) m.row = kHeld;
    steps.assign(landmark_count, Vec<S, D>::Zero());
    roots_.resize(landmark_count);
  }

  // Takes landmark i, with its edges [first, last), out of the system of views and planes: S -= W H^-1 W^T, b
  // -= W H^-1 g, with Y = W L^-T where H = L L^T.
  template <class System, class Right>
  void eliminate(std::size_t i, std::size_t first, std::size_t last, S damping, System& system,
                 Right& right) {
    Mat<S, D, D> damped = landmarks[i].H;
    for (int a = 0; a < D; ++a) damped(a, a) += damping * std::max(damped(a, a), S(1e-9));
    roots_[i].setZero();  // a landmark that nothing fixes stays where it is
    if (!inverse_root<S, D>(damped, roots_[i])) return;
    const Vec<S, D> z = roots_[i] * landmarks[i].g;
    reduced_.resize(last - first);
    for (std::size_t e = first; e < last; ++e) {
      const Eigen::Index row = mixed[e].row;
      if (row == kHeld) continue;
      Mat<S, 6, D>& y = reduced_[e - first];
      y = times_transposed_lower<S, 6, D>(mixed[e].W, roots_[i]);
      for (int d = 0; d < D; ++d)
        for (int r = 0; r < 6; ++r) right[row + r] -= y(r, d) * z[d];
      for (std::size_t f = first; f <= e; ++f) {
        const Eigen::Index col = mixed[f].row;
        if (col == kHeld) continue;
        const Mat<S, 6, D>& other = reduced_[f - first];
        if (row >= col) subtract_outer<S, 6, 6, D>(y, other, &system(row, col), system.rows());
        if (row <= col && f != e) subtract_outer<S, 6, 6, D>(other, y, &system(col, row), system.rows());
      }
    }
    const Eigen::Index row = planes[i].row;  // below those of the views
    if (row == kHeld) return;
    const Mat<S, 3, D> y = times_transposed_lower<S, 3, D>(planes[i].W, roots_[i]);
    for (int d = 0; d < D; ++d)
      for (int r = 0; r < 3; ++r) right[row + r] -= y(r, d) * z[d];
    for (std::size_t e = first; e < last; ++e)
      if (mixed[e].row != kHeld)
        subtract_outer<S, 3, 6, D>(y, reduced_[e - first], &system(row, mixed[e].row), system.rows());
    subtract_outer<S, 3, 3, D>(y, y, &system(row, row), system.rows());
  }

  // The landmark's own step once those of views and planes are known: H^-1 (-g - sum W^T d).
  template <class Step>
  void substitute(std::size_t i, std::size_t first, std::size_t last, const Step& known) {
    Vec<S, D> right = -landmarks[i].g;
    for (std::size_t e = first; e < last; ++e)
      if (mixed[e].row != kHeld)
        add_product<S, 6, D>(mixed[e].W, known.template segment<6>(mixed[e].row), S(-1), right);
    if (planes[i].row != kHeld)
      add_product<S, 3, D>(planes[i].W, known.template segment<3>(planes[i].row), S(-1), right);
    steps[i] = roots_[i].transpose() * (roots_[i] * right);
  }

 private:
  std::vector<Mat<S, D, D>> roots_;    // L^-1
  std::vector<Mat<S, 6, D>> reduced_;  // of one landmark's edges
};

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
    system_.setZero(size, size);
    right_.resize(size);
    for (std::size_t v = 0; v < views_.size(); ++v)
      if (rows_[v] != kHeld) put<6>(views_[v], rows_[v], damping);
    for (std::size_t p = 0; p < planes_.size(); ++p) put<3>(planes_[p], plane_row(p), damping);
    for_each(graph.points, [&](auto i, auto first, auto last) {
      points.eliminate(i, first, last, damping, system_, right_);
    });
    for_each(graph.lines, [&](auto i, auto first, auto last) {
      lines.eliminate(i, first, last, damping, system_, right_);
    });
    for (std::size_t v = 0; v < rows_.size(); ++v)
      if (turning_[v] != 0)
        for (int a = 3; a < 6; ++a) system_(rows_[v] + a, rows_[v] + a) = 1;  // its gradient there is zero
    factor_.compute(system_);
    if (factor_.info() != Eigen::Success) return false;
    steps_ = -factor_.solve(right_);
    if (!steps_.allFinite()) return false;
    for_each(graph.points, [&](auto i, auto first, auto last) { points.substitute(i, first, last, steps_); });
    for_each(graph.lines, [&](auto i, auto first, auto last) { lines.substitute(i, first, last, steps_); });
    return true;
  }

  // Zero for a held view.
  [[nodiscard]] Vec6<S> view_step(std::size_t view) const {
    if (rows_[view] == kHeld) return Vec6<S>::Zero();
    return steps_.template segment<6>(rows_[view]);
  }
  [[nodiscard]] Vec3<S> plane_step(std::size_t plane) const {
    return steps_.template segment<3>(plane_row(plane));
  }

 private:
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

  template <int D>
  void put(const BlockEquations<S, D>& block, Eigen::Index at, S damping) {
    system_.template block<D, D>(at, at) = block.H;
    for (Eigen::Index a = at; a < at + D; ++a) system_(a, a) += damping * std::max(system_(a, a), S(1e-9));
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

  using MatX = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  using VecX = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  std::vector<BlockEquations<S, 6>> views_;
  std::vector<BlockEquations<S, 3>> planes_;
  std::vector<Eigen::Index> rows_;     // by view: where it begins in the system, or kHeld
  Eigen::Index plane_rows_ = 0;        // where the planes begin
  std::vector<std::uint8_t> turning_;  // by view: 1 where the centre is held
  MatX system_;                        // lower half
  VecX right_, steps_;
  Eigen::LLT<MatX> factor_;
};

}  // namespace sslam
